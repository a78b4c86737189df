// Bells: narrow petals that overlap to a tube from the stalk on and whose tips curl back, as those
// of bluebells and hyacinths, and the buds they open from.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_PETALS = 10, STREAM_STAMENS = 200 }; // of a bell; + number
enum { STREAM_CURL = 1, STREAM_ROLL = 2, STREAM_OUT = 3, STREAM_AGE = 4 };

enum { MOST_ROWS = 19, MOST_COLUMNS = 7 };
#define TUBE 0.64f // share of a petal's length that belongs to the tube

// What a petal is drawn by.
typedef struct Petal {
    float length, radius; // m: along it, of the tube
    float half;           // m: half of its width
    float turn;           // degrees about the axis
    float curl;           // degrees by which it bends back beyond the tube
    float bud;            // 0..1: from open to closed
    float flat;           // 0..1: share of its hollow that its tip keeps
} Petal;

// Half width at s in 0..1 along the petal, relative to the largest: parallel sides, a blunt point.
static float half_at(float s)
{
    float late = fmaxf((s - 0.52f) / 0.48f, 0.0f);
    return lerpf(0.62f, 1.0f, smoothstepf(0.0f, 0.3f, s)) *
           sqrtf(fmaxf(1.0f - late * late * late, 0.0009f));
}

// Radius of the tube at s, relative to its own: rounded at the stalk, a little narrower at 0.4.
static float tube_at(float s)
{
    float t = clampf(s / 0.16f, 0.0f, 1.0f);
    return lerpf(0.22f, 1.0f, sqrtf(t * (2.0f - t))) *
           (1.0f - 0.1f * smoothstepf(0.16f, 0.42f, s) + 0.1f * smoothstepf(0.5f, TUBE, s));
}

// Radius of a bud at s, relative to the tube's.
static float bud_at(float s)
{
    float t = clampf(s / 0.3f, 0.0f, 1.0f), late = clampf((s - 0.55f) / 0.45f, 0.0f, 1.0f);
    return lerpf(0.25f, 0.95f, sqrtf(t * (2.0f - t))) * sqrtf(fmaxf(1.0f - late * late, 0.004f));
}

// Distance from the axis and height of the petal's middle line at `rows` steps along it.
static void middle_line(const Petal *p, int rows, Vec2 *line)
{
    float y = 0.0f, x = 0.0f;
    for (int r = 0; r < rows; r++) {
        float s = (float)r / (float)(rows - 1), step = 1.0f / (float)(rows - 1);
        float beyond = clampf((s - TUBE) / (1.0f - TUBE), 0.0f, 1.0f);
        float sine, cosine;
        float before = clampf((s - 0.5f * step - TUBE) / (1.0f - TUBE), 0.0f, 1.0f);
        exact_sincos(p->curl * before * (0.35f + 0.65f * before) * RADIANS_PER_DEGREE, &sine,
                     &cosine);
        if (r > 0) {
            y += step * p->length * cosine;
            x += step * p->length * sine;
        }
        float tube = tube_at(fminf(s, TUBE)) * p->radius;
        float open = beyond > 0.0f ? tube + x : tube;
        line[r] = (Vec2){lerpf(open, bud_at(s) * p->radius, p->bud), y};
    }
}

static void add_petal(Quads *quads, const Petal *p, int rows, int columns)
{
    Vec2 line[MOST_ROWS];
    middle_line(p, rows, line);
    uint32_t first = (uint32_t)quads->vertex_count;
    for (int r = 0; r < rows; r++) {
        float s = (float)r / (float)(rows - 1), half = p->half * half_at(s);
        half *= lerpf(1.0f, fminf(line[r].x / p->radius + 0.1f, 1.0f), p->bud);
        // A tip is less hollow than the tube that it was part of.
        float hollow = fmaxf(line[r].x, 0.3f * p->radius);
        hollow *= lerpf(1.0f, 1.0f / p->flat, smoothstepf(TUBE, 1.0f, s) * (1.0f - p->bud));
        for (int c = 0; c < columns; c++) {
            float across = (float)c / (float)(columns - 1) * 2.0f - 1.0f;
            float sine, cosine, ridge = fmaxf(1.0f - 2.5f * fabsf(across), 0.0f);
            exact_sincos(across * half / hollow, &sine, &cosine);
            float out = line[r].x - hollow * (1.0f - cosine) + 0.035f * p->radius * ridge;
            float aside = hollow * sine;
            exact_sincos(p->turn * RADIANS_PER_DEGREE, &sine, &cosine);
            quads_vertex(quads,
                         vec3(out * cosine - aside * sine, line[r].y, out * sine + aside * cosine),
                         (Vec2){0.5f + 0.5f * across, s});
        }
    }
    quads_grid(quads, first, rows, columns);
}

static void add_petals(OrganBuild *build, float bud, float curl, uint64_t seed)
{
    const OrganParams *p = build->params;
    int rows = p->detail > 1 ? MOST_ROWS : p->detail > 0 ? 9 : 4;
    int columns = p->detail > 1 ? MOST_COLUMNS : 3;
    for (int i = 0; i < p->petals; i++) {
        uint64_t key = random_key(seed, STREAM_PETALS + (uint64_t)i);
        bool inner = i % 2 != 0;
        float share = PI_F * p->width / (float)p->petals; // of the tube's girth, m
        Petal petal = {
            .length = p->length,
            .radius = 0.5f * p->width * (inner ? 0.93f : 1.0f),
            .half = (inner ? 0.62f : 0.56f) * share,
            .turn = 360.0f * (float)i / (float)p->petals +
                    random_range(random_key(key, STREAM_ROLL), -6.0f, 6.0f),
            .curl = curl * random_range(random_key(key, STREAM_CURL), 0.8f, 1.15f),
            .bud = bud,
            .flat = random_range(random_key(key, STREAM_OUT), 0.3f, 0.6f),
        };
        add_petal(&build->tissue[TISSUE_PETAL], &petal, rows, columns);
    }
}

// Stamens with their bags of pollen in the mouth, half of them a little deeper, and the style.
static void add_stamens(OrganBuild *build, uint64_t seed)
{
    enum { POINTS = 5 };
    const OrganParams *p = build->params;
    static const float along[POINTS] = {-0.09f, -0.06f, 0.0f, 0.06f, 0.085f};
    static const float wide[POINTS] = {0.02f, 0.075f, 0.085f, 0.07f, 0.015f};
    for (int i = 0; i < p->petals; i++) {
        uint64_t key = random_key(seed, STREAM_STAMENS + (uint64_t)i);
        float turn = 360.0f * (float)i / (float)p->petals, x, z;
        exact_sincos(turn * RADIANS_PER_DEGREE, &z, &x);
        float from = (i % 2 != 0 ? 0.5f : 0.6f) + random_range(key, -0.03f, 0.03f);
        float out = 0.27f * p->width;
        Vec3 foot = vec3(0.4f * p->width * x, 0.3f * p->length, 0.4f * p->width * z);
        Vec3 head = vec3(out * x, from * p->length, out * z);
        const Vec3 thread[2] = {foot, head};
        const float thin[2] = {0.03f * p->width, 0.025f * p->width};
        quads_tube(&build->tissue[TISSUE_PETAL], thread, thin, 2, 3, (Vec2){0.5f, 0.3f});
        Vec3 axis[POINTS];
        float radius[POINTS];
        for (int k = 0; k < POINTS; k++) {
            axis[k] = vec3(head.x, head.y + along[k] * p->length, head.z);
            radius[k] = wide[k] * p->width;
        }
        quads_tube(&build->tissue[TISSUE_ANTHER], axis, radius, POINTS, 5, (Vec2){0.5f, 1.0f});
    }
    const Vec3 style[2] = {{0, 0.1f * p->length, 0}, {0, 0.58f * p->length, 0}};
    const float radius[2] = {0.05f * p->width, 0.03f * p->width};
    quads_tube(&build->tissue[TISSUE_PETAL], style, radius, 2, 4, (Vec2){0.5f, 0.3f});
}

void organ_bell(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    // From the first of a cluster on they are open; the last, the share `buds`, are not.
    float age = random_range(random_key(seed, STREAM_AGE), -0.06f, 0.06f);
    float ripe = p->buds > 0.0f ? (1.0f - p->buds - build->rank + age) / 0.22f + 0.5f : 1.0f;
    float bud = 1.0f - clampf(ripe, 0.0f, 1.0f);
    float curl = p->open * 235.0f * (1.0f - bud) * clampf(0.55f + 0.25f * ripe, 0.0f, 1.0f);
    add_petals(build, bud, curl, seed);
    if (p->detail > 1 && bud < 0.5f) {
        add_stamens(build, seed);
    }
}
