// Cones, catkins and buds: scales around an axis, turned by the golden angle from one to the next
// (phyllotaxis after Vogel, 1979).
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_SCALES = 10 }; // of an organ; + number
enum { STREAM_OPEN = 1, STREAM_SIZE = 2 };

// Half width of the body at t in 0..1 from its base, relative to the largest.
static float body_half(float t, float egg)
{
    // An ellipse whose widest place lies nearer to the base for a large egg.
    float widest = 0.5f - 0.18f * egg;
    float x = t < widest ? (widest - t) / widest : (t - widest) / (1.0f - widest);
    return sqrtf(fmaxf(1.0f - x * x, 0.0f));
}

typedef struct Scales {
    int count;
    float length, width; // m, of the longest scale
    float closed, open;  // degrees to the axis
    float egg;           // form of the body
    float core;          // radius of the core relative to the body's
    float cup;
} Scales;

static void add_scales(OrganBuild *build, const Scales *scales, uint64_t seed)
{
    enum { ROWS = 4 };
    const OrganParams *p = build->params;
    Quads *wood = &build->tissue[TISSUE_WOOD];
    const Transform *outer = wood->place;
    for (int i = 0; i < (p->detail > 0 ? scales->count : 0); i++) {
        uint64_t key = random_key(seed, STREAM_SCALES + (uint64_t)i);
        float t = ((float)i + 0.5f) / (float)scales->count;
        float half = 0.5f * p->width * body_half(0.02f + 0.96f * t, scales->egg);
        float size = (0.35f + 0.65f * 2.0f * half / p->width) *
                     random_range(random_key(key, STREAM_SIZE), 0.92f, 1.05f);
        // Those in the middle open widest; those of the tip point forward.
        float open = lerpf(scales->closed, scales->open, p->open) * (1.15f - 0.75f * t) +
                     random_range(random_key(key, STREAM_OPEN), -4.0f, 4.0f);
        float turn = (float)i * ORGAN_DIVERGENCE, sine, cosine;
        exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
        float core = scales->core * half;
        Vec3 foot = vec3(core * cosine, t * p->length * 0.94f, core * sine);
        Transform frame = organ_frame(foot, open, turn);
        Transform place = transform_multiply(outer, &frame);
        wood->place = &place;
        const float length = scales->length * size, width = 0.5f * scales->width * size;
        const float at[ROWS] = {0.0f, 0.5f * length, 0.85f * length, length};
        const float wide[ROWS] = {0.45f * width, width, 0.8f * width, 0.25f * width};
        const float lift[ROWS] = {0.0f, -0.06f * length, 0.0f, 0.1f * length};
        organ_sheet(wood, at, wide, lift, ROWS, scales->cup);
        wood->place = outer;
    }
    enum { RINGS = 7 };
    Vec2 core[RINGS];
    // Without scales the body reaches about as far as they do.
    float thick = p->detail > 0 ? fmaxf(scales->core, 0.2f) : 0.85f + 0.3f * p->open;
    for (int i = 0; i < RINGS; i++) {
        float t = (float)i / (RINGS - 1);
        float half = body_half(0.04f + 0.92f * t, scales->egg);
        core[i] = (Vec2){thick * 0.5f * p->width * half, t * p->length * 0.94f};
    }
    quads_revolve(wood, core, RINGS, p->detail > 1 ? 8 : 5);
}

void organ_cone(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    float slender = p->length / p->width; // a spruce's has small scales, a pine's few large ones
    int count = (int)(clampf(slender, 1.0f, 6.0f) * 28.0f) + 12;
    Scales scales = {.count = count,
                     .length = p->width * (slender > 2.2f ? 0.62f : 0.55f),
                     .width = p->width * (slender > 2.2f ? 0.6f : 0.5f),
                     .closed = 14.0f,
                     .open = slender > 2.2f ? 42.0f : 85.0f,
                     .egg = slender > 2.2f ? 0.15f : 0.8f,
                     .core = 0.62f - 0.37f * p->open,
                     .cup = 0.35f};
    add_scales(build, &scales, seed);
}

void organ_catkin(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    float slender = clampf(p->length / p->width, 1.0f, 16.0f);
    Scales scales = {.count = (int)((p->detail > 1 ? 16.0f : 8.0f) * slender),
                     .length = 0.36f * p->width,
                     .width = p->detail > 1 ? 0.42f * p->width : 0.6f * p->width,
                     .closed = 18.0f,
                     .open = 78.0f,
                     .egg = 0.1f,
                     .core = 0.6f,
                     .cup = 0.3f};
    add_scales(build, &scales, seed);
}

// Half width of a bud at t in 0..1 from its base, relative to the largest: broad below, pointed.
static float bud_half(float t)
{
    const float widest = 0.35f;
    float x = (t - widest) / (1.0f - widest);
    return t < widest ? 0.7f + 0.3f * t / widest : 1.0f - x * x;
}

// Overlapping scales as steps of a body of revolution.
void organ_bud(OrganBuild *build, uint64_t seed)
{
    (void)seed;
    enum { STEPS = 5 };
    const OrganParams *p = build->params;
    Vec2 profile[2 * STEPS + 1];
    for (int i = 0; i < STEPS; i++) {
        // Each scale's rim stands off the next one.
        float low = (float)i / STEPS, high = ((float)i + 0.8f) / STEPS;
        profile[2 * i] = (Vec2){0.44f * p->width * bud_half(low), low * p->length};
        profile[2 * i + 1] = (Vec2){0.52f * p->width * bud_half(high), high * p->length};
    }
    profile[2 * STEPS] = (Vec2){0.01f * p->width, p->length};
    quads_revolve(&build->tissue[TISSUE_WOOD], profile, 2 * STEPS + 1, p->detail > 1 ? 10 : 6);
}
