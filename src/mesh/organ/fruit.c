// Fruit and nuts: bodies of revolution, with cups, spikes or wings; and spines.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_SPIKES = 10 }; // of an organ; + number
enum { STREAM_LENGTH = 1, STREAM_OPEN = 2, STREAM_TURN = 3 };

enum { MOST_RINGS = 17 };

// An ellipsoid from y = 0 to `length`, drawn in at both ends by the dimple.
static void add_body(Quads *quads, float length, float width, float dimple, int rings, int sides)
{
    Vec2 profile[MOST_RINGS];
    for (int i = 0; i < rings; i++) {
        float sine, cosine, t = (float)i / (float)(rings - 1);
        exact_sincos(PI_F * (0.02f + 0.96f * t), &sine, &cosine);
        // The dimple lowers the ends but not the shoulders.
        float end = cosine * cosine * cosine * cosine;
        float sunk = dimple * 0.3f * end * end;
        float fuller = 1.0f + 0.1f * dimple * cosine; // an apple is broader at the stalk
        profile[i] =
            (Vec2){0.5f * width * sine * fuller, 0.5f * length * (1.0f - cosine * (1.0f - sunk))};
    }
    quads_revolve(quads, profile, rings, sides);
}

void organ_fruit(OrganBuild *build, uint64_t seed)
{
    (void)seed;
    const OrganParams *p = build->params;
    bool fine = p->detail > 1;
    Quads *flesh = &build->tissue[TISSUE_FLESH];
    // The stalk reaches into the dimple.
    const Transform *outer = flesh->place;
    Transform back = transform_identity();
    back.m[1][3] = -0.09f * p->dimple * p->length;
    Transform place = transform_multiply(outer, &back);
    flesh->place = &place;
    add_body(flesh, p->length, p->width, p->dimple, fine ? MOST_RINGS : 7, fine ? 20 : 8);
    flesh->place = outer;
}

void organ_acorn(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    int sides = p->detail > 1 ? 14 : 7;
    const Vec2 nut[7] = {
        {0.44f * p->width, 0.12f * p->length}, {0.49f * p->width, 0.35f * p->length},
        {0.48f * p->width, 0.6f * p->length},  {0.38f * p->width, 0.82f * p->length},
        {0.18f * p->width, 0.94f * p->length}, {0.06f * p->width, 0.97f * p->length},
        {0.01f * p->width, 1.04f * p->length}};
    quads_revolve(&build->tissue[TISSUE_FLESH], nut, 7, sides);
    const Vec2 cup[6] = {
        {0.05f * p->width, -0.03f * p->length}, {0.36f * p->width, 0.02f * p->length},
        {0.54f * p->width, 0.16f * p->length},  {0.57f * p->width, 0.36f * p->length},
        {0.5f * p->width, 0.37f * p->length},   {0.46f * p->width, 0.3f * p->length}};
    Quads *wood = &build->tissue[TISSUE_WOOD];
    quads_revolve(wood, cup, 6, sides);
    const Transform *outer = wood->place;
    int scales = p->detail > 1 ? 70 : 0;
    for (int i = 0; i < scales; i++) {
        float t = ((float)i + 0.5f) / (float)scales, sine, cosine;
        float turn = (float)i * ORGAN_DIVERGENCE, half = (0.2f + 0.37f * sqrtf(t)) * p->width;
        exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
        Transform frame =
            organ_frame(vec3(half * cosine, (0.3f * t * t - 0.01f) * p->length, half * sine),
                        40.0f - 30.0f * t, turn);
        Transform place = transform_multiply(outer, &frame);
        wood->place = &place;
        const float at[3] = {0, 0.05f * p->length, 0.1f * p->length};
        const float wide[3] = {0.05f * p->width, 0.06f * p->width, 0.01f * p->width};
        const float lift[3] = {-0.02f * p->width, -0.03f * p->width, -0.01f * p->width};
        organ_sheet(wood, at, wide, lift, 3, 0.1f);
        wood->place = outer;
    }
    (void)seed;
}

// A spike or spine from p along the frame's y axis.
static void add_spike(Quads *quads, const Transform *frame, float length, float radius, int sides)
{
    const Vec3 axis[3] = {transform_point(frame, vec3(0, 0, 0)),
                          transform_point(frame, vec3(0, 0.5f * length, 0)),
                          transform_point(frame, vec3(0, length, 0))};
    const float thick[3] = {radius, 0.55f * radius, 0.03f * radius};
    quads_tube(quads, axis, thick, 3, sides, (Vec2){0.5f, 0.5f});
}

void organ_husk(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    bool fine = p->detail > 1;
    Quads *flesh = &build->tissue[TISSUE_FLESH];
    add_body(flesh, p->length, p->width, 0.0f, fine ? 13 : 7, fine ? 16 : 8);
    int spikes = fine ? 90 : 40;
    for (int i = 0; i < spikes; i++) {
        uint64_t key = random_key(seed, STREAM_SPIKES + (uint64_t)i);
        float y = 1.0f - 2.0f * ((float)i + 0.5f) / (float)spikes, sine, cosine;
        float turn = (float)i * ORGAN_DIVERGENCE, round = sqrtf(1.0f - y * y);
        exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 foot = vec3(0.49f * p->width * round * cosine, 0.5f * p->length * (1.0f + 0.98f * y),
                         0.49f * p->width * round * sine);
        float open = exact_acos(y) / RADIANS_PER_DEGREE +
                     random_range(random_key(key, STREAM_OPEN), -12.0f, 12.0f);
        Transform frame = organ_frame(foot, open, turn);
        add_spike(flesh, &frame,
                  p->width * random_range(random_key(key, STREAM_LENGTH), 0.1f, 0.17f),
                  0.03f * p->width, 4);
    }
}

// Two nuts with wings that part by an angle which grows with `open`.
void organ_samara(OrganBuild *build, uint64_t seed)
{
    enum { ROWS = 8 };
    (void)seed;
    const OrganParams *p = build->params;
    Quads *wing = &build->tissue[TISSUE_WING], *flesh = &build->tissue[TISSUE_FLESH];
    const Transform *outer = wing->place;
    static const float share[ROWS] = {0.08f, 0.2f, 0.35f, 0.5f, 0.65f, 0.8f, 0.92f, 1.0f};
    // The wing's front edge is straight and thick, its back bulges.
    static const float back[ROWS] = {0.18f, 0.3f, 0.55f, 0.8f, 0.97f, 1.0f, 0.8f, 0.4f};
    for (int side = -1; side <= 1; side += 2) {
        float open = (float)side * lerpf(25.0f, 80.0f, p->open), sine, cosine;
        exact_sincos(open * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 y = vec3(sine, cosine, 0), x = vec3(cosine, -sine, 0);
        Transform frame = transform_from_axes(x, y, vec3(0, 0, 1), vec3(0, 0, 0));
        Transform place = transform_multiply(outer, &frame);
        wing->place = flesh->place = &place;
        uint32_t first = (uint32_t)wing->vertex_count;
        for (int r = 0; r < ROWS; r++) {
            for (int c = 0; c < 4; c++) {
                float u = (float)c / 3.0f;
                // From the front edge, which looks outward, to the back.
                float across = p->width * (0.1f - back[r] * u) * (float)side;
                quads_vertex(wing,
                             vec3(-across, share[r] * p->length,
                                  0.03f * p->width * (u - 0.5f) * (float)side),
                             (Vec2){u, share[r]});
            }
        }
        quads_grid(wing, first, ROWS, 4);
        add_body(flesh, 0.28f * p->length, 0.2f * p->length, 0.0f, 6, 6);
        wing->place = flesh->place = outer;
    }
}

void organ_thorn(OrganBuild *build, uint64_t seed)
{
    (void)seed;
    const OrganParams *p = build->params;
    Transform identity = transform_identity();
    add_spike(&build->tissue[TISSUE_WOOD], &identity, p->length, 0.5f * p->width, 5);
}
