// Water lilies: sepals that are green below, whorls of boat-shaped petals that grow smaller and
// steeper inward and pass into broad stamens about a flat stigma.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_SEPALS = 10, STREAM_PETALS = 100, STREAM_STAMENS = 200 }; // of a flower; + number
// Of a petal.
enum { STREAM_OPEN = 1, STREAM_TURN = 2, STREAM_SIZE = 3, STREAM_BEND = 4, STREAM_EDGE = 5 };
enum { STREAM_STAGE = 6 }; // of a flower

enum { SEPALS = 4, MOST_ROWS = 15, MOST_COLUMNS = 9 };

// A boat-shaped sheet from the origin along +Y that faces +Z, where it is hollow.
typedef struct Boat {
    float length, width; // m
    float base;          // half width at its foot, relative to the largest
    float widest;        // 0..1 along it
    float bend;          // degrees by which it bends toward +Z over its length
    float cup;           // how far its sides rise, in half widths
    float twist;         // how far one side rises above the other, in half widths
    float ragged, phase; // waves of its margin, in widths; degrees
    float behind;        // m toward -Z
} Boat;

static float wave(float degrees)
{
    float sine, cosine;
    exact_sincos(degrees * RADIANS_PER_DEGREE, &sine, &cosine);
    return sine;
}

// Half width at `along`, relative to the largest: to a blunt point.
static float outline(const Boat *b, float along)
{
    if (along < b->widest) {
        return lerpf(b->base, 1.0f, wave(90.0f * along / b->widest));
    }
    float x = (along - b->widest) / (1.0f - b->widest);
    return fmaxf(exact_pow(fmaxf(1.0f - exact_pow(x, 2.3f), 0.0f), 0.7f), 0.03f);
}

static Vec3 boat_point(const Boat *b, float along, float across)
{
    float half = 0.5f * b->width * outline(b, along), sine, cosine;
    float bend = fmaxf(b->bend * RADIANS_PER_DEGREE, 1e-3f);
    exact_sincos(bend * along, &sine, &cosine);
    float rise = b->cup * half * across * across * (1.0f - 0.35f * along);
    rise += b->twist * half * across * along;
    rise += b->ragged * b->width * along * across * across *
            wave(300.0f * along + 120.0f * across + b->phase);
    rise -= 0.05f * half * fmaxf(1.0f - fabsf(across) / 0.35f, 0.0f); // the keel
    rise -= b->behind;
    // Up from an arc, along its normal.
    return vec3(half * across * (1.0f - 0.12f * b->cup), b->length * sine / bend - rise * sine,
                b->length * (1.0f - cosine) / bend + rise * cosine);
}

static void add_boat(Quads *quads, const Boat *boat, int detail)
{
    int rows = detail > 1 ? MOST_ROWS : detail > 0 ? 6 : 3;
    int columns = detail > 1 ? MOST_COLUMNS : detail > 0 ? 5 : 3;
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        float along = (float)r / (float)(rows - 1);
        for (int c = 0; c < columns; c++) {
            float across = (float)c / (float)(columns - 1) * 2.0f - 1.0f;
            quads_vertex(quads, boat_point(boat, along, across),
                         (Vec2){0.5f + 0.5f * across, along});
        }
    }
    quads_grid(quads, first, rows, columns);
}

// Adds a boat whose foot is at p, `open` degrees from +Y toward the azimuth `turn`.
static void add_boat_at(OrganBuild *build, OrganTissue tissue, Vec3 p, float open, float turn,
                        const Boat *boat)
{
    Quads *quads = &build->tissue[tissue];
    const Transform *outer = quads->place;
    Transform frame = organ_frame(p, open, turn);
    Transform place = outer ? transform_multiply(outer, &frame) : frame;
    quads->place = &place;
    add_boat(quads, boat, build->params->detail);
    quads->place = outer;
}

// The foot of a part on the receptacle: `inner` 0..1 from its rim to the middle, toward `turn`.
static Vec3 foot(const OrganParams *p, float inner, float turn)
{
    float sine, cosine, r = p->length * lerpf(0.13f, 0.05f, inner);
    exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
    return vec3(r * cosine, p->length * 0.1f * inner, r * sine);
}

// Degrees from upright of the parts at `inner` 0..1 of a flower that is `wide` open.
static float leaning(float wide, float inner)
{
    return lerpf(14.0f + 68.0f * wide, 4.0f + 42.0f * wide, inner);
}

// A sepal is white inside and green outside: two sheets.
static void add_sepals(OrganBuild *build, float open, float bend, float cup, float width,
                       uint64_t seed)
{
    const OrganParams *p = build->params;
    for (int i = 0; i < SEPALS; i++) {
        uint64_t key = random_key(seed, STREAM_SEPALS + (uint64_t)i);
        float turn =
            360.0f * (float)i / SEPALS + random_range(random_key(key, STREAM_TURN), -9.0f, 9.0f);
        Boat sepal = {.length =
                          p->length * random_range(random_key(key, STREAM_SIZE), 0.92f, 1.02f),
                      .width = width * p->width,
                      .base = 0.5f,
                      .widest = 0.45f,
                      .bend = bend + random_range(random_key(key, STREAM_BEND), -8.0f, 8.0f),
                      .cup = cup};
        float lean = open + random_range(random_key(key, STREAM_OPEN), -6.0f, 6.0f);
        if (build->params->detail > 0) {
            add_boat_at(build, TISSUE_PETAL, foot(p, 0.0f, turn), lean, turn, &sepal);
        }
        sepal.behind = 0.012f * p->length;
        sepal.width *= 1.02f;
        add_boat_at(build, TISSUE_GREEN, foot(p, 0.0f, turn), lean, turn, &sepal);
    }
}

static void add_petals(OrganBuild *build, float wide, uint64_t seed)
{
    const OrganParams *p = build->params;
    for (int i = 0; i < p->petals; i++) {
        uint64_t key = random_key(seed, STREAM_PETALS + (uint64_t)i);
        float inner = ((float)i + 0.5f) / (float)p->petals;
        float turn = 45.0f + (float)i * ORGAN_DIVERGENCE +
                     random_range(random_key(key, STREAM_TURN), -8.0f, 8.0f);
        float size = lerpf(1.0f, 0.64f, inner * inner) *
                     random_range(random_key(key, STREAM_SIZE), 0.92f, 1.04f);
        Boat petal = {.length = size * p->length,
                      .width = p->width * lerpf(1.0f, 0.55f, inner),
                      .base = 0.4f,
                      .widest = 0.52f,
                      .bend = lerpf(24.0f, 34.0f, inner) +
                              random_range(random_key(key, STREAM_BEND), -12.0f, 14.0f),
                      .cup = lerpf(0.85f, 0.5f, wide),
                      .twist = random_range(random_key(key, STREAM_EDGE), -0.16f, 0.16f),
                      .ragged = 0.012f,
                      .phase = 360.0f * random_unit(random_key(key, STREAM_EDGE))};
        float lean = leaning(wide, inner) + random_range(random_key(key, STREAM_OPEN), -7.0f, 7.0f);
        add_boat_at(build, TISSUE_PETAL, foot(p, inner, turn), lean, turn, &petal);
    }
}

// The outer stamens are broad as petals, the inner ones threads; all bend inward.
static void add_stamens(OrganBuild *build, float wide, uint64_t seed)
{
    const OrganParams *p = build->params;
    int stamens = p->detail > 1 ? 64 : p->detail > 0 ? 20 : 6;
    for (int i = 0; i < stamens; i++) {
        uint64_t key = random_key(seed, STREAM_STAMENS + (uint64_t)i);
        float inner = ((float)i + 0.5f) / (float)stamens;
        float turn =
            (float)i * ORGAN_DIVERGENCE + random_range(random_key(key, STREAM_TURN), -9.0f, 9.0f);
        Boat stamen = {.length = p->length * lerpf(0.6f, 0.36f, inner) *
                                 random_range(random_key(key, STREAM_SIZE), 0.86f, 1.08f),
                       .width = p->length * lerpf(0.085f, 0.035f, fminf(2.0f * inner, 1.0f)),
                       .base = 0.7f,
                       .widest = 0.4f,
                       .bend = lerpf(38.0f, 75.0f, inner) +
                               random_range(random_key(key, STREAM_BEND), -18.0f, 18.0f),
                       .cup = 0.5f};
        float lean = lerpf(12.0f + 40.0f * wide, 8.0f, inner) +
                     random_range(random_key(key, STREAM_OPEN), -6.0f, 6.0f);
        Vec3 at = foot(p, 1.0f, turn);
        at = vec3(at.x * lerpf(1.0f, 0.75f, inner), at.y, at.z * lerpf(1.0f, 0.75f, inner));
        add_boat_at(build, TISSUE_ANTHER, at, lean, turn, &stamen);
    }
}

// The receptacle below, and the stigma: a shallow bowl.
static void add_middle(OrganBuild *build)
{
    const float length = build->params->length;
    int sides = build->params->detail > 1 ? 16 : 6;
    const Vec2 below[4] = {{0.03f * length, -0.07f * length},
                           {0.12f * length, -0.04f * length},
                           {0.145f * length, 0.02f * length},
                           {0.06f * length, 0.1f * length}};
    quads_revolve(&build->tissue[TISSUE_GREEN], below, 4, sides);
    const Vec2 stigma[4] = {{0.05f * length, 0.08f * length},
                            {0.075f * length, 0.15f * length},
                            {0.06f * length, 0.16f * length},
                            {0.012f * length, 0.13f * length}};
    quads_revolve(&build->tissue[TISSUE_ANTHER], stigma, 4, sides);
}

// A bud: petals rolled into an egg within their sepals, between which they show.
static void add_closed(OrganBuild *build, uint64_t seed)
{
    enum { RINGS = 7 };
    static const float share[RINGS] = {0.0f, 0.15f, 0.35f, 0.55f, 0.75f, 0.92f, 1.0f};
    static const float round[RINGS] = {0.45f, 0.75f, 0.96f, 1.0f, 0.8f, 0.42f, 0.03f};
    const OrganParams *p = build->params;
    float length = 0.86f * p->length;
    Vec2 egg[RINGS];
    for (int i = 0; i < RINGS; i++) {
        egg[i] = (Vec2){0.2f * length * round[i], length * share[i]};
    }
    quads_revolve(&build->tissue[TISSUE_PETAL], egg, RINGS, p->detail > 1 ? 16 : 6);
    add_sepals(build, 20.0f, 44.0f, 0.5f, 1.3f, seed);
}

void organ_water_lily(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    if (organ_is_closed(p, seed)) {
        add_closed(build, seed);
        return;
    }
    float young = random_unit(random_key(seed, STREAM_STAGE));
    float wide = p->open * (1.0f - 0.4f * young * young * young);
    add_sepals(build, fminf(leaning(wide, 0.0f) + 7.0f, 90.0f), 16.0f, 0.35f, 1.05f, seed);
    add_petals(build, wide, seed);
    add_stamens(build, wide, seed);
    add_middle(build);
}
