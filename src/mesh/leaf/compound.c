#include "mesh/leaf/compound.h"

#include "base/exact_math.h"
#include "base/random.h"

// Of a leaf; LEAFLETS + i: leaflet i.
enum { STREAM_LEAFLETS = 10 };
enum { STREAM_SIZE = 1, STREAM_ANGLE = 2, STREAM_DROOP = 3, STREAM_FORM = 4 }; // of a leaflet

enum { RACHIS_PIECES = 12 };

// An axis that starts at the origin along +Y and bends toward -Z.
typedef struct Rachis {
    Vec3 point[RACHIS_PIECES + 1];
    float bend; // radians, over all of it
} Rachis;

static Rachis rachis_make(Vec3 start, float length, float bend_degrees)
{
    Rachis rachis = {.bend = bend_degrees * RADIANS_PER_DEGREE};
    rachis.point[0] = start;
    for (int i = 0; i < RACHIS_PIECES; i++) {
        float sine, cosine;
        exact_sincos(rachis.bend * ((float)i + 0.5f) / RACHIS_PIECES, &sine, &cosine);
        rachis.point[i + 1] =
            vec3_madd(rachis.point[i], length / RACHIS_PIECES, vec3(0, cosine, -sine));
    }
    return rachis;
}

// A frame at t in 0..1: y along the axis, z up from the leaf.
static Transform rachis_at(const Rachis *rachis, float t)
{
    float at = clampf(t, 0.0f, 1.0f) * RACHIS_PIECES, sine, cosine;
    int piece = at < RACHIS_PIECES ? (int)at : RACHIS_PIECES - 1;
    Vec3 p = vec3_lerp(rachis->point[piece], rachis->point[piece + 1], at - (float)piece);
    exact_sincos(rachis->bend * t, &sine, &cosine);
    return transform_from_axes(vec3(1, 0, 0), vec3(0, cosine, -sine), vec3(0, sine, cosine), p);
}

// A frame within `frame`, its y axis turned by `turn` from y toward x and down by `droop` (both
// radians), scaled.
static Transform turned(const Transform *frame, float turn, float droop, float scale)
{
    float sine, cosine, down, level;
    exact_sincos(turn, &sine, &cosine);
    exact_sincos(droop, &down, &level);
    Vec3 y = vec3(sine * level, cosine * level, -down);
    Vec3 x = vec3(cosine, -sine, 0);
    Transform own = transform_from_axes(vec3_scale(x, scale), vec3_scale(y, scale),
                                        vec3_scale(vec3_cross(x, y), scale), vec3(0, 0, 0));
    return transform_multiply(frame, &own);
}

// Adds a leaflet of the given size in the frame, with a short stalk of its own.
static void add_leaflet(Quads *quads, const LeafParams *leaf, const Transform *frame, float length,
                        float width, BladeDetail detail, uint64_t key)
{
    LeafParams leaflet = *leaf;
    leaflet.compound = COMPOUND_NONE;
    leaflet.length = length;
    leaflet.width = width;
    leaflet.petiole = 0.02f * length;
    leaflet.curl = 14.0f;
    const Transform *outer = quads->place;
    Transform place = outer ? transform_multiply(outer, frame) : *frame;
    quads->place = &place;
    blade_add(quads, &leaflet, detail, random_key(key, STREAM_FORM));
    quads->place = outer;
}

// Leaflet length at t along a rachis, relative to the longest: shorter toward the tip by taper, and
// at the base of long fronds.
static float size_at(const LeafParams *params, float t)
{
    float many = params->leaflets > 20 ? smoothstepf(-0.25f, 0.3f, t) : 1.0f;
    return many * (1.0f - params->taper * t * sqrtf(t));
}

typedef struct Pinna {
    float t, turn, size; // along the rachis; radians to it; relative length
    uint64_t key;
} Pinna;

// Leaflet number i of `count` on a rachis: the last is at its end if the count is odd.
static Pinna pinna_of(const LeafParams *params, int count, int i, uint64_t seed)
{
    uint64_t key = random_key(seed, STREAM_LEAFLETS + (uint64_t)i);
    int pairs = count / 2, pair = i / 2;
    bool last = i == 2 * pairs;
    float bare = count > 20 ? 0.06f : 0.22f; // of the rachis below the leaflets
    float end = count % 2 ? 1.0f - 0.5f * (1.0f - bare) / ((float)pairs + 0.5f) : 1.0f;
    float t = last        ? 1.0f
              : pairs > 1 ? bare + (end - bare) * (float)pair / (float)(pairs - 1)
              : count % 2 ? 0.6f
                          : 1.0f;
    float open =
        lerpf(72.0f, 42.0f, t) + 8.0f * (random_unit(random_key(key, STREAM_ANGLE)) - 0.5f);
    float vary = random_range(random_key(key, STREAM_SIZE), 0.92f, 1.04f);
    return (Pinna){t, last ? 0.0f : (i % 2 ? 1.0f : -1.0f) * open * RADIANS_PER_DEGREE,
                   size_at(params, t) * vary * (last ? 1.05f : 1.0f), key};
}

static float droop_of(const Pinna *pinna)
{
    return random_range(random_key(pinna->key, STREAM_DROOP), -0.05f, 0.3f);
}

// Length of the longest leaflet: half the leaf's width at its angle to the rachis.
static float leaflet_length(const LeafParams *params)
{
    return 0.5f * params->width / 0.87f;
}

static float leaflet_width(const LeafParams *params)
{
    return params->leaflet_width > 0.0f ? params->leaflet_width : 0.36f * leaflet_length(params);
}

// The rachis ends below the leaflet or pair at its end, which belongs to the leaf's length.
static float rachis_length(const LeafParams *params)
{
    float share = params->leaflets % 2 ? 1.0f : 0.74f; // a pair opens by 42 degrees
    float last = share * leaflet_length(params) * size_at(params, 1.0f);
    return fmaxf(params->length - last, 0.4f * params->length);
}

static void add_pinnate(Quads *quads, const LeafParams *params, const Rachis *rachis, int count,
                        float length, float width, BladeDetail detail, uint64_t seed)
{
    for (int i = 0; i < count; i++) {
        Pinna pinna = pinna_of(params, count, i, seed);
        Transform at = rachis_at(rachis, pinna.t);
        Transform frame = turned(&at, pinna.turn, droop_of(&pinna), 1.0f);
        float narrow = sqrtf(pinna.size); // short leaflets are wider in proportion
        add_leaflet(quads, params, &frame, length * pinna.size, width * narrow, detail, pinna.key);
    }
}

static Rachis part_rachis(const LeafParams *params, float length)
{
    return rachis_make(vec3(0, 0, 0), length, 0.3f * params->curl);
}

static void add_bipinnate(Quads *quads, const LeafParams *params, const Rachis *rachis,
                          BladeDetail detail, float widen, uint64_t seed)
{
    float length = leaflet_length(params), width = leaflet_width(params);
    int each = params->leaflets_of_part > 1 ? params->leaflets_of_part : 2;
    // Leaflets of a part are as long as their distance, so that they fill the leaf.
    for (int i = 0; i < params->leaflets; i++) {
        Pinna pinna = pinna_of(params, params->leaflets, i, seed);
        Transform at = rachis_at(rachis, pinna.t);
        Transform frame = turned(&at, pinna.turn, droop_of(&pinna), 1.0f);
        float part = length * pinna.size, wide = fminf(width, part);
        if (detail == BLADE_KITE) {
            add_leaflet(quads, params, &frame, part, wide * widen, BLADE_KITE, pinna.key);
            continue;
        }
        const Transform *outer = quads->place;
        Transform place = outer ? transform_multiply(outer, &frame) : frame;
        quads->place = &place;
        Rachis own = part_rachis(params, part);
        float leaflet = 0.5f * wide * (0.3f + 0.7f * pinna.size) / 0.87f;
        float gap = 1.7f * part / (float)each;
        add_pinnate(quads, params, &own, each, leaflet, fminf(0.5f * leaflet, 0.92f * gap) * widen,
                    detail == BLADE_FINE ? BLADE_SMOOTH : BLADE_KITE, pinna.key);
        quads->place = outer;
    }
}

// Leaflets from one point: that in the middle the largest.
static void add_palmate(Quads *quads, const LeafParams *params, BladeDetail detail, float widen,
                        uint64_t seed)
{
    int n = params->leaflets;
    float step = (20.0f + 165.0f / (float)n) * RADIANS_PER_DEGREE;
    float middle = 0.5f * (float)(n - 1);
    Rachis stalk = rachis_make(vec3(0, params->petiole, 0), 0.02f * params->length, 0.0f);
    Transform end = rachis_at(&stalk, 1.0f);
    float width = params->leaflet_width > 0.0f ? params->leaflet_width : 0.38f * params->length;
    for (int i = 0; i < n; i++) {
        uint64_t key = random_key(seed, STREAM_LEAFLETS + (uint64_t)i);
        float from = ((float)i - middle) / fmaxf(middle, 1.0f);
        float turn =
            ((float)i - middle) * step + random_range(random_key(key, STREAM_ANGLE), -0.06f, 0.06f);
        float size =
            (1.0f - 0.42f * from * from) * random_range(random_key(key, STREAM_SIZE), 0.94f, 1.04f);
        float droop = params->curl * RADIANS_PER_DEGREE * 0.6f +
                      random_range(random_key(key, STREAM_DROOP), 0.0f, 0.2f);
        Transform frame = turned(&end, turn, droop, 1.0f);
        add_leaflet(quads, params, &frame, 0.98f * params->length * size, width * size * widen,
                    detail, key);
    }
}

void compound_add(Quads *quads, const LeafParams *params, BladeDetail detail, float widen,
                  uint64_t seed)
{
    Rachis rachis = rachis_make(vec3(0, params->petiole, 0), rachis_length(params), params->curl);
    if (params->compound == COMPOUND_PALMATE) {
        add_palmate(quads, params, detail, widen, seed);
    } else if (params->compound == COMPOUND_BIPINNATE) {
        add_bipinnate(quads, params, &rachis, detail, widen, seed);
    } else {
        add_pinnate(quads, params, &rachis, params->leaflets, leaflet_length(params),
                    leaflet_width(params) * widen, detail, seed);
    }
}

void compound_add_rachis(Quads *quads, const LeafParams *params)
{
    if (params->compound == COMPOUND_PALMATE) {
        return; // the stalk alone
    }
    Rachis rachis = rachis_make(vec3(0, params->petiole, 0), rachis_length(params), params->curl);
    float radius[RACHIS_PIECES + 1], thick = fmaxf(0.004f * params->length, 0.0004f);
    for (int i = 0; i <= RACHIS_PIECES; i++) {
        radius[i] = thick * (1.0f - 0.8f * (float)i / RACHIS_PIECES);
        rachis.point[i].z -= 0.8f * radius[i];
    }
    quads_tube(quads, rachis.point, radius, RACHIS_PIECES + 1, 3, (Vec2){0.5f, 0.0f});
}
