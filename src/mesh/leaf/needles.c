#include "mesh/leaf/needles.h"

#include "base/exact_math.h"
#include "base/random.h"

// Of a piece; NEEDLES + i: needle i, SHOOTS + i: side shoot i.
enum { STREAM_NEEDLES = 10, STREAM_SHOOTS = 1000000 };
enum {
    STREAM_TURN = 1,
    STREAM_OPEN = 2,
    STREAM_LENGTH = 3,
    STREAM_ROLL = 4,
    STREAM_PLACE = 5,
    STREAM_YOUTH = 6
};

#define GOLDEN_ANGLE 137.507764f

// Of round needles and twiglets: beside the veins that a leaf's pattern draws.
#define BODY_UV ((Vec2){0.25f, 0.5f})

typedef struct Needle {
    Vec3 base, along, side; // side: unit, across
    float length, width;    // m
} Needle;

// A flat needle: widest in its first third, then tapered.
static void add_flat(Quads *quads, const Needle *needle)
{
    static const float share[3] = {0.0f, 0.35f, 1.0f}, half[3] = {0.35f, 0.5f, 0.12f};
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int i = 0; i < 3; i += 1) {
        Vec3 p = vec3_madd(needle->base, share[i] * needle->length, needle->along);
        for (int s = -1; s <= 1; s += 2) {
            quads_vertex(quads, vec3_madd(p, (float)s * half[i] * needle->width, needle->side),
                         (Vec2){0.5f + 0.5f * (float)s, share[i]});
        }
    }
    quads_grid(quads, first, 3, 2);
}

static void add_kite(Quads *quads, const Needle *needle)
{
    Vec3 middle = vec3_madd(needle->base, 0.45f * needle->length, needle->along);
    Vec3 end = vec3_madd(needle->base, needle->length, needle->along);
    uint32_t a = quads_vertex(quads, vec3_madd(middle, -0.5f * needle->width, needle->side),
                              (Vec2){0, 0.45f});
    uint32_t b = quads_vertex(quads, needle->base, (Vec2){0.5f, 0});
    uint32_t c = quads_vertex(quads, vec3_madd(middle, 0.5f * needle->width, needle->side),
                              (Vec2){1, 0.45f});
    uint32_t d = quads_vertex(quads, end, (Vec2){0.5f, 1});
    quads_face(quads, a, b, c, d);
}

static void add_prism(Quads *quads, const Needle *needle)
{
    static const float share[4] = {0.0f, 0.08f, 0.8f, 1.0f}, half[4] = {0.3f, 0.5f, 0.48f, 0.06f};
    Vec3 axis[4];
    float radius[4];
    for (int i = 0; i < 4; i++) {
        axis[i] = vec3_madd(needle->base, share[i] * needle->length, needle->along);
        radius[i] = half[i] * needle->width;
    }
    quads_tube(quads, axis, radius, 4, 3, BODY_UV);
}

static void add_needle(Quads *quads, const Needle *needle, bool prism, bool kite)
{
    if (prism) {
        add_prism(quads, needle);
    } else if (kite) {
        add_kite(quads, needle);
    } else {
        add_flat(quads, needle);
    }
}

// Direction of a needle that opens by `angle` (degrees) from +Y toward the azimuth `turn`.
static Vec3 opened(float angle, float turn, float comb)
{
    float open_sine, open_cosine, sine, cosine;
    exact_sincos(angle * RADIANS_PER_DEGREE, &open_sine, &open_cosine);
    exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
    // Combed needles lie to both sides, those from below and above turned toward them.
    float side = cosine < 0.0f ? -1.0f : 1.0f;
    Vec3 out = vec3(lerpf(cosine, side, comb), 0, sine * (1.0f - comb) + 0.15f * comb);
    return vec3_normalize(vec3_madd(vec3(0, open_cosine, 0), open_sine, vec3_normalize(out)));
}

// Needle number k of a bundle of `bundle` about the direction `along`.
static Vec3 bundled(Vec3 along, int k, int bundle, uint64_t key)
{
    if (bundle <= 1) {
        return along;
    }
    Vec3 x = vec3_perpendicular(along), z = vec3_cross(x, along);
    float sine, cosine;
    exact_sincos(2.0f * PI_F *
                     ((float)k / (float)bundle + random_unit(random_key(key, STREAM_ROLL))),
                 &sine, &cosine);
    Vec3 out = vec3_madd(vec3_scale(x, cosine), sine, z);
    return vec3_normalize(vec3_madd(along, 0.13f, out));
}

// How young needles are that stand at this share 0..1 of their shoot: those of this year are all of
// one kind, older ones keep a little of it by chance.
static float youth(const LeafParams *params, float place, uint64_t key)
{
    float chance = random_unit(random_key(key, STREAM_YOUTH));
    return place > 1.0f - params->flush ? 0.75f + 0.25f * chance : 0.25f * chance * chance;
}

// All needles of a shoot as one quad, which reaches as far as they do.
static void add_whole_shoot(Quads *quads, const LeafParams *params, float widen, uint64_t seed)
{
    float turn = random_range(random_key(seed, STREAM_ROLL), 0.0f, 2.0f * PI_F), sine, cosine;
    exact_sincos(turn, &sine, &cosine);
    Needle needle = {.along = vec3(0, 1, 0),
                     .side = vec3(cosine, 0, sine),
                     .length = params->shoot + 0.5f * params->length,
                     .width = params->width * widen};
    quads->young = 0.8f * params->flush; // the mean
    add_kite(quads, &needle);
}

static void add_shoot(Quads *quads, const LeafParams *params, int stride, float widen, bool prisms,
                      uint64_t seed)
{
    if (stride == NEEDLES_AS_SHOOTS) {
        add_whole_shoot(quads, params, widen, seed);
        return;
    }
    int bundle = params->bundle > 1 ? params->bundle : 1;
    for (int i = 0; i < params->needles; i += stride) {
        int number = i / bundle;
        uint64_t bundle_key = random_key(seed, STREAM_NEEDLES + (uint64_t)number);
        uint64_t key = random_key(bundle_key, (uint64_t)(i % bundle));
        float place = ((float)number + random_unit(random_key(bundle_key, STREAM_PLACE))) *
                      (float)bundle / (float)params->needles;
        float turn = (float)number * GOLDEN_ANGLE +
                     random_range(random_key(bundle_key, STREAM_TURN), -14.0f, 14.0f);
        float open =
            params->needle_angle * random_range(random_key(bundle_key, STREAM_OPEN), 0.75f, 1.2f);
        Vec3 along = bundled(opened(open, turn, params->comb), i % bundle, bundle, bundle_key);
        Vec3 side = vec3_cross(along, random_direction(random_key(key, STREAM_ROLL)));
        Needle needle = {
            .base = vec3(0, clampf(place, 0.0f, 1.0f) * params->shoot, 0),
            .along = along,
            .side = vec3_dot(side, side) > 1e-6f ? vec3_normalize(side) : vec3_perpendicular(along),
            .length = params->length * random_range(random_key(key, STREAM_LENGTH), 0.8f, 1.05f),
            .width = params->width * widen};
        quads->young = youth(params, place, key);
        add_needle(quads, &needle, prisms, stride > 1 || params->side_shoots > 0);
    }
    quads->young = 0.0f;
    if (stride == 1 && params->side_shoots > 0) {
        const Vec3 axis[2] = {vec3(0, 0, 0), vec3(0, params->shoot, 0)};
        const float radius[2] = {1.1f * params->width, 0.4f * params->width};
        quads_tube(quads, axis, radius, 2, 3, (Vec2){0.5f, 0.0f});
    }
}

// A branchlet: a shoot with side shoots to its left and right, or all round if not combed, shorter
// toward its tip and bent down by `curl`. Every shoot has as many needles for its length.
static void add_branchlet(Quads *quads, const LeafParams *params, int stride, float widen,
                          bool prisms, uint64_t seed)
{
    add_shoot(quads, params, stride, widen, prisms, seed);
    const Transform *outer = quads->place;
    for (int i = 0; i < params->side_shoots; i++) {
        uint64_t key = random_key(seed, STREAM_SHOOTS + (uint64_t)i);
        int pair = i / 2;
        float t = ((float)i + 0.6f) / ((float)params->side_shoots + 0.6f);
        float turn = (float)(i % 2) * 180.0f + (1.0f - params->comb) * (float)pair * 77.0f +
                     random_range(random_key(key, STREAM_TURN), -12.0f, 12.0f);
        float open = 52.0f * random_range(random_key(key, STREAM_OPEN), 0.8f, 1.15f);
        Vec3 y = opened(open, turn, 0.0f), sag = vec3(0, 0, -params->curl * RADIANS_PER_DEGREE);
        y = vec3_normalize(vec3_add(y, sag));
        Vec3 z = vec3_normalize(vec3_madd(vec3(0, 0, 1), -y.z, y));
        Transform own = transform_from_axes(vec3_cross(y, z), y, z, vec3(0, t * params->shoot, 0));
        Transform place = outer ? transform_multiply(outer, &own) : own;
        LeafParams side = *params;
        side.shoot *=
            0.5f * (1.0f - 0.72f * t) * random_range(random_key(key, STREAM_LENGTH), 0.8f, 1.2f);
        side.needles = (int)((float)params->needles * side.shoot / params->shoot);
        quads->place = &place;
        add_shoot(quads, &side, stride, widen, prisms, key);
        quads->place = outer;
    }
}

// A rosette: needles about +Y, from upright in the middle to level at the rim, on a knob.
static void add_tuft(Quads *quads, const LeafParams *params, int stride, float widen, bool prisms,
                     uint64_t seed)
{
    for (int i = 0; i < params->needles; i += stride) {
        uint64_t key = random_key(seed, STREAM_NEEDLES + (uint64_t)i);
        float rank = ((float)i + 0.5f) / (float)params->needles;
        float open = params->needle_angle * (0.15f + 1.15f * sqrtf(rank)) +
                     random_range(random_key(key, STREAM_OPEN), -9.0f, 9.0f);
        Vec3 along = opened(open, (float)i * GOLDEN_ANGLE, 0.0f);
        Vec3 side = vec3_cross(along, random_direction(random_key(key, STREAM_ROLL)));
        Needle needle = {
            .base = vec3_madd(vec3(0, params->shoot, 0), 0.02f * params->length, along),
            .along = along,
            .side = vec3_dot(side, side) > 1e-6f ? vec3_normalize(side) : vec3_perpendicular(along),
            .length = params->length * random_range(random_key(key, STREAM_LENGTH), 0.7f, 1.05f),
            .width = params->width * widen};
        add_needle(quads, &needle, prisms, stride > 1);
    }
    if (stride == 1 && params->shoot > 0.0f) {
        float thick = fmaxf(0.5f * params->shoot, params->width);
        Vec3 axis[3] = {vec3(0, -0.1f * params->shoot, 0), vec3(0, 0.7f * params->shoot, 0),
                        vec3(0, 1.05f * params->shoot, 0)};
        float radius[3] = {thick, thick, 0.2f * thick};
        quads_tube(quads, axis, radius, 3, 5, (Vec2){0.5f, 0.0f});
    }
}

// A twiglet covered with scales: a tapered body with a notch at the end of every scale.
static void add_twiglet(Quads *quads, Vec3 base, Vec3 along, float length, float width, int rings)
{
    enum { MOST_RINGS = 24 };
    Vec3 axis[MOST_RINGS];
    float radius[MOST_RINGS];
    rings = rings < MOST_RINGS ? rings : MOST_RINGS;
    for (int i = 0; i < rings; i++) {
        float t = (float)i / (float)(rings - 1);
        bool notch = i % 2 == 1 && i + 1 < rings;
        axis[i] = vec3_madd(base, t * length, along);
        radius[i] = 0.5f * width * (1.0f - 0.75f * t * t) * (notch ? 0.72f : 1.0f);
    }
    quads_tube(quads, axis, radius, rings, rings > 3 ? 4 : 3, BODY_UV);
}

// A twiglet with alternating side twiglets, in the plane of its direction and `side`.
static void add_feather(Quads *quads, Vec3 base, Vec3 along, Vec3 side, float length, float width,
                        int rings)
{
    enum { SIDES = 6 };
    add_twiglet(quads, base, along, length, width, rings);
    for (int k = 0; k < SIDES; k++) {
        float t = 0.18f + 0.68f * (float)k / (SIDES - 1);
        Vec3 out = vec3_normalize(vec3_madd(along, k % 2 ? 0.8f : -0.8f, side));
        add_twiglet(quads, vec3_madd(base, t * length, along), out, (0.55f - 0.3f * t) * length,
                    0.85f * width, rings > 4 ? rings / 2 : 2);
    }
}

// A spray: an axis of length `shoot` with `needles` twiglets of the given length, alternating about
// it and shorter toward its tip; each bears short ones.
static void add_scales(Quads *quads, const LeafParams *params, int stride, float widen, bool fine,
                       uint64_t seed)
{
    int rings = fine ? 16 : stride > 1 ? 2 : 4;
    float width = params->width * widen;
    if (stride == 1) {
        add_twiglet(quads, vec3(0, 0, 0), vec3(0, 1, 0), params->shoot, 1.3f * width, rings);
    }
    for (int i = 0; i < params->needles; i += stride) {
        uint64_t key = random_key(seed, STREAM_NEEDLES + (uint64_t)i);
        float t = ((float)i + 0.5f) / (float)params->needles;
        int pair = i / 2;
        float turn = (float)(i % 2) * 180.0f + (1.0f - params->comb) * (float)pair * 77.0f +
                     random_range(random_key(key, STREAM_TURN), -20.0f, 20.0f);
        float open =
            params->needle_angle * random_range(random_key(key, STREAM_OPEN), 0.75f, 1.15f);
        float length = params->length * (1.0f - 0.7f * t) *
                       random_range(random_key(key, STREAM_LENGTH), 0.8f, 1.1f);
        Vec3 base = vec3(0, t * params->shoot, 0), along = opened(open, turn, 0.0f);
        if (stride == 1) {
            // The side twiglets lie in the plane of axis and twiglet.
            Vec3 up = vec3_madd(vec3(0, 1, 0), -along.y, along);
            add_feather(quads, base, along, vec3_normalize(up), length, width, rings);
        } else {
            add_twiglet(quads, base, along, length, width, rings);
        }
    }
}

void needles_add(Quads *quads, const LeafParams *params, int stride, float widen, bool prisms,
                 uint64_t seed)
{
    if (params->shape == LEAF_TUFT) {
        add_tuft(quads, params, stride, widen, prisms, seed);
    } else if (params->shape == LEAF_SCALES) {
        add_scales(quads, params, stride, widen, prisms, seed);
    } else if (needles_branch(params)) {
        add_branchlet(quads, params, stride, widen, prisms, seed);
    } else {
        add_shoot(quads, params, stride, widen, prisms, seed);
    }
}
