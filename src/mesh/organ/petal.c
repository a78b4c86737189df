// Petals of blossoms that are seen from near, and the short shoots that bear their clusters.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_NOTCH = 11, STREAM_TWIST = 12, STREAM_BOWL = 13, STREAM_WAVE = 14, STREAM_EDGE = 15 };
enum { STREAM_SCALES = 40 }; // of a spur; + number

enum { ROWS = 9, COLUMNS = 9 };

// What is a petal's own.
typedef struct Petal {
    float length, width; // m
    float bowl;          // how far its end rises, in lengths
    float cup;           // how far its sides rise, in half widths
    float twist;         // one side above, the other below the next petal
    float notch, ragged; // depth of the notch and of the margin's waves, in lengths
    float phase;         // degrees, of the waves
} Petal;

// Half width at each row, relative to the largest: a claw, then egg-shaped.
static const float WIDE[ROWS] = {0.10f, 0.30f, 0.56f, 0.78f, 0.93f, 1.0f, 0.97f, 0.84f, 0.58f};

static float wave(float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * RADIANS_PER_DEGREE, &sine, &cosine);
    return sine;
}

// The point at `along` (0..1) of row r and `across` (-1..1).
static Vec3 petal_point(const Petal *p, int r, float along, float across)
{
    float half = 0.5f * p->width * WIDE[r], side = across * across;
    float middle = fmaxf(1.0f - fabsf(across) / 0.4f, 0.0f), late = along * along;
    float end = 1.0f - p->notch * middle * (2.0f - middle) - 0.13f * side * side +
                p->ragged * wave(260.0f * across + p->phase);
    float y = p->length * along * lerpf(1.0f, end, late * along);
    float z = p->length * p->bowl * late + p->cup * half * side * (1.0f - 0.45f * along);
    z += half * across * p->twist * along;
    z += p->length * p->ragged * late * (0.4f + side) *
         wave(360.0f * along + 250.0f * across + 2.0f * p->phase);
    // A crease along the middle.
    z -= 0.02f * p->length * along * middle;
    return vec3(half * across, y, z);
}

void organ_petal(Quads *quads, float length, float width, float open, uint64_t key)
{
    Petal petal = {.length = length,
                   .width = width,
                   .bowl = lerpf(0.5f, 0.1f, open) +
                           random_range(random_key(key, STREAM_BOWL), -0.1f, 0.12f),
                   .cup = lerpf(0.75f, 0.32f, open),
                   .twist = random_range(random_key(key, STREAM_TWIST), 0.0f, 0.22f),
                   .notch = random_range(random_key(key, STREAM_NOTCH), 0.03f, 0.15f),
                   .ragged = random_range(random_key(key, STREAM_EDGE), 0.006f, 0.02f),
                   .phase = random_range(random_key(key, STREAM_WAVE), 0.0f, 360.0f)};
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < ROWS; r++) {
        float along = (float)r / (ROWS - 1);
        for (int c = 0; c < COLUMNS; c++) {
            float across = (float)c / (COLUMNS - 1) * 2.0f - 1.0f;
            quads_vertex(quads, petal_point(&petal, r, along, across),
                         (Vec2){0.5f + 0.5f * across, along});
        }
    }
    quads_grid(quads, first, ROWS, COLUMNS);
}

// Bud scales about the shoot's end, the outer ones short and turned back.
static void add_bud_scales(OrganBuild *build, float radius, uint64_t seed)
{
    enum { SCALES = 8, SCALE_ROWS = 4 };
    const OrganParams *p = build->params;
    Quads *wood = &build->tissue[TISSUE_WOOD];
    const Transform *outer = wood->place;
    float length = 2.6f * radius;
    static const float share[SCALE_ROWS] = {0.0f, 0.4f, 0.75f, 1.0f};
    static const float wide[SCALE_ROWS] = {0.3f, 0.46f, 0.36f, 0.05f};
    for (int i = 0; i < SCALES; i++) {
        uint64_t key = random_key(seed, STREAM_SCALES + (uint64_t)i);
        float inner = (float)i / (SCALES - 1);
        float open = lerpf(85.0f, 22.0f, inner) + random_range(key, -10.0f, 10.0f);
        float size = length * lerpf(0.55f, 1.0f, inner);
        Transform frame = organ_frame(vec3(0, p->spur - 0.3f * radius * (1.0f - inner), 0), open,
                                      (float)i * ORGAN_DIVERGENCE);
        Transform place = outer ? transform_multiply(outer, &frame) : frame;
        float at[SCALE_ROWS], half[SCALE_ROWS], lift[SCALE_ROWS];
        for (int r = 0; r < SCALE_ROWS; r++) {
            at[r] = 0.5f * radius + size * share[r];
            half[r] = size * wide[r];
            lift[r] = 0.12f * size * share[r] * share[r];
        }
        wood->place = &place;
        organ_sheet(wood, at, half, lift, SCALE_ROWS, 0.5f);
        wood->place = outer;
    }
}

void organ_spur(OrganBuild *build, uint64_t seed)
{
    enum { YEARS = 4, RINGS = 3 * YEARS + 1 };
    const OrganParams *p = build->params;
    float radius = clampf(0.17f * p->spur, 0.0012f, 0.004f);
    Vec2 profile[RINGS];
    for (int i = 0; i < YEARS; i++) {
        float at = p->spur * (float)i / YEARS, year = p->spur / YEARS;
        float thick = radius * random_range(random_key(seed, (uint64_t)i), 0.8f, 1.0f);
        profile[3 * i] = (Vec2){0.85f * thick, at};
        profile[3 * i + 1] = (Vec2){0.82f * thick, at + 0.6f * year};
        profile[3 * i + 2] = (Vec2){1.12f * thick, at + 0.82f * year};
    }
    profile[RINGS - 1] = (Vec2){0.3f * radius, p->spur};
    quads_revolve(&build->tissue[TISSUE_WOOD], profile, RINGS, 8);
    if (p->detail > 1) {
        add_bud_scales(build, radius, seed);
    }
}
