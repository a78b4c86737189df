// Blossom: whorls of petals about a centre of stamens, with sepals below.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_PETALS = 10, STREAM_STAMENS = 200 }; // of a flower; + number
enum { STREAM_OPEN = 1, STREAM_ROLL = 2, STREAM_LENGTH = 3, STREAM_STAGE = 4, STREAM_CLOSED = 5 };

enum { PETALS_OF_WHORL = 5, SEPALS = 5, STAMENS = 30, ROWS = 6 }; // stamens: at detail 2

// A petal of a few pixels, folded along its middle, of about the area of a true one.
static void add_plain_petal(Quads *quads, float length, float width, float cup)
{
    float half = 0.55f * width, sag = -0.12f * length;
    const Vec3 corner[6] = {{0, 0, 0},
                            {0.85f * half, 0.45f * length, 0.2f * sag + 0.7f * cup * half},
                            {0.8f * half, 0.92f * length, 0.8f * sag + 0.6f * cup * half},
                            {0, 0.95f * length, sag},
                            {-0.8f * half, 0.92f * length, 0.8f * sag + 0.6f * cup * half},
                            {-0.85f * half, 0.45f * length, 0.2f * sag + 0.7f * cup * half}};
    uint32_t v[6];
    for (int i = 0; i < 6; i++) {
        v[i] = quads_vertex(quads, corner[i],
                            (Vec2){0.5f + 0.5f * corner[i].x / half, corner[i].y / length});
    }
    quads_face(quads, v[0], v[1], v[2], v[3]);
    quads_face(quads, v[0], v[3], v[4], v[5]);
}

// A petal: narrow at its base, broad and notched at its end, hollow like a spoon.
static void add_petal(Quads *quads, float length, float width, float cup, uint64_t key)
{
    float at[ROWS], half[ROWS], lift[ROWS];
    static const float share[ROWS] = {0.0f, 0.2f, 0.45f, 0.7f, 0.9f, 1.0f};
    static const float wide[ROWS] = {0.12f, 0.45f, 0.85f, 1.0f, 0.8f, 0.42f};
    float bend = random_range(random_key(key, STREAM_LENGTH), 0.08f, 0.22f);
    for (int r = 0; r < ROWS; r++) {
        at[r] = length * share[r];
        half[r] = 0.5f * width * wide[r];
        lift[r] = -bend * length * share[r] * share[r] * (1.0f - 0.3f * share[r]);
    }
    uint32_t first = (uint32_t)quads->vertex_count;
    organ_sheet(quads, at, half, lift, ROWS, cup);
    // The notch: the last row's middle drawn back. The sheet lies in the place's frame, so move it
    // along the line to the row before.
    if (!quads->failed) {
        uint32_t middle = first + (ROWS - 1) * 5 + 2, before = middle - 5;
        quads->position[middle] =
            vec3_lerp(quads->position[middle], quads->position[before], 0.55f);
    }
}

// A whorl's petals are wide open or, of a young flower, still half closed.
static float openness(const OrganParams *p, uint64_t seed)
{
    if (p->detail < 2) {
        return p->open;
    }
    float young = random_unit(random_key(seed, STREAM_STAGE));
    return p->open * (1.0f - 0.5f * young * young * young);
}

static void add_whorls(OrganBuild *build, const Transform *outer, float wide, uint64_t seed)
{
    const OrganParams *p = build->params;
    int petals = p->petals > 0 ? p->petals : PETALS_OF_WHORL;
    int whorls = (petals + PETALS_OF_WHORL - 1) / PETALS_OF_WHORL;
    int each = (petals + whorls - 1) / whorls;
    for (int i = 0; i < petals; i++) {
        uint64_t key = random_key(seed, STREAM_PETALS + (uint64_t)i);
        int whorl = i / each;
        float inner = whorls > 1 ? (float)whorl / (float)(whorls - 1) : 0.0f;
        float open = 12.0f + wide * lerpf(66.0f, 20.0f, inner) +
                     random_range(random_key(key, STREAM_OPEN), -7.0f, 7.0f);
        float turn = 360.0f * ((float)i + 0.5f * (float)whorl) / (float)each +
                     random_range(random_key(key, STREAM_ROLL), -5.0f, 5.0f);
        Transform frame = organ_frame(vec3(0, 0.02f * p->length * (float)whorl, 0), open, turn);
        Transform place = transform_multiply(outer, &frame);
        Quads *quads = &build->tissue[TISSUE_PETAL];
        quads->place = &place;
        float size = 1.0f - 0.3f * inner;
        float cup = 0.35f - 0.2f * p->open;
        if (p->detail > 1) {
            organ_petal(quads, size * p->length, size * p->width, wide, key);
        } else if (p->detail > 0) {
            add_petal(quads, size * p->length, size * p->width, cup, key);
        } else {
            add_plain_petal(quads, size * p->length, size * p->width, cup);
        }
        quads->place = outer;
    }
}

// A thread, and near the end of it a bag of pollen.
static void add_stamen(OrganBuild *build, const Transform *frame, float length)
{
    enum { POINTS = 4 };
    const OrganParams *p = build->params;
    static const float share[POINTS] = {0.0f, 0.88f, 0.94f, 1.0f};
    static const float thick[POINTS] = {0.012f, 0.009f, 0.035f, 0.01f};
    Vec3 axis[POINTS];
    float radius[POINTS];
    for (int k = 0; k < POINTS; k++) {
        axis[k] = transform_point(frame, vec3(0, share[k] * length, 0));
        radius[k] = thick[k] * p->length;
    }
    if (p->detail < 2) {
        quads_tube(&build->tissue[TISSUE_GREEN], axis, radius, POINTS, 3, (Vec2){0.5f, 1.0f});
        return;
    }
    // Filaments are of the petals' white and spread in an arc.
    for (int k = 0; k < POINTS; k++) {
        float t = share[k], arc = 0.22f * length * t * (1.0f - t);
        axis[k] = transform_point(frame, vec3(0, t * length, arc));
        radius[k] = 0.014f * p->length * (1.0f - 0.3f * t);
    }
    quads_tube(&build->tissue[TISSUE_PETAL], axis, radius, POINTS, 3, (Vec2){0.5f, 1.0f});
    static const float along[POINTS] = {-0.045f, -0.02f, 0.02f, 0.05f};
    static const float wide[POINTS] = {0.008f, 0.03f, 0.032f, 0.006f};
    for (int k = 0; k < POINTS; k++) {
        axis[k] = transform_point(frame, vec3(0, length + along[k] * p->length, 0));
        radius[k] = wide[k] * p->length;
    }
    quads_tube(&build->tissue[TISSUE_ANTHER], axis, radius, POINTS, 5, (Vec2){0.5f, 1.0f});
}

static void add_stamens(OrganBuild *build, float wide, uint64_t seed)
{
    const OrganParams *p = build->params;
    int stamens = p->detail > 1 ? STAMENS : 6;
    float spread = p->detail > 1 ? 30.0f + 35.0f * wide : 45.0f;
    for (int i = 0; i < stamens && p->open > 0.25f; i++) {
        uint64_t key = random_key(seed, STREAM_STAMENS + (uint64_t)i);
        float open = spread * sqrtf(((float)i + 0.5f) / (float)stamens);
        float least = p->detail > 1 ? 0.5f : 0.4f, most = p->detail > 1 ? 0.78f : 0.6f;
        float length = p->length * random_range(random_key(key, STREAM_LENGTH), least, most);
        Transform frame = organ_frame(vec3(0, 0, 0), open, (float)i * ORGAN_DIVERGENCE);
        add_stamen(build, &frame, length);
    }
    if (p->detail > 1) { // the style
        const Vec3 axis[2] = {{0, 0, 0}, {0, 0.62f * p->length, 0}};
        const float radius[2] = {0.02f * p->length, 0.016f * p->length};
        quads_tube(&build->tissue[TISSUE_GREEN], axis, radius, 2, 4, (Vec2){0.5f, 1.0f});
    }
}

// Sepals below the petals, turned back as far as `open` degrees from +Y.
static void add_sepals(OrganBuild *build, float open, float cup)
{
    const OrganParams *p = build->params;
    Quads *green = &build->tissue[TISSUE_GREEN];
    const Transform *outer = green->place;
    for (int i = 0; i < SEPALS; i++) {
        Transform frame =
            organ_frame(vec3(0, -0.03f * p->length, 0), open, 360.0f * ((float)i + 0.5f) / SEPALS);
        Transform place = transform_multiply(outer, &frame);
        green->place = &place;
        const float at[3] = {0.05f * p->length, 0.25f * p->length, 0.42f * p->length};
        const float half[3] = {0.06f * p->length, 0.08f * p->length, 0.01f * p->length};
        const float lift[3] = {0, 0, 0};
        organ_sheet(green, at, half, lift, 3, cup);
        green->place = outer;
    }
}

bool organ_is_closed(const OrganParams *params, uint64_t seed)
{
    bool opens = params->kind == ORGAN_BLOSSOM || params->kind == ORGAN_WATER_LILY;
    return opens && params->buds > 0.0f &&
           random_unit(random_key(seed, STREAM_CLOSED)) < params->buds;
}

// A closed blossom: petals rolled into an egg, half of it still in its sepals.
static void add_closed(OrganBuild *build, uint64_t seed)
{
    enum { RINGS = 7 };
    const OrganParams *p = build->params;
    static const float share[RINGS] = {0.0f, 0.15f, 0.35f, 0.55f, 0.75f, 0.92f, 1.0f};
    static const float wide[RINGS] = {0.35f, 0.7f, 0.95f, 1.0f, 0.82f, 0.45f, 0.04f};
    float length = p->length * random_range(random_key(seed, STREAM_LENGTH), 0.4f, 0.72f);
    Vec2 profile[RINGS];
    for (int i = 0; i < RINGS; i++) {
        profile[i] = (Vec2){0.36f * length * wide[i], length * share[i]};
    }
    quads_revolve(&build->tissue[TISSUE_PETAL], profile, RINGS, p->detail > 1 ? 10 : 6);
}

// The urn below a blossom.
static void add_urn(OrganBuild *build)
{
    const OrganParams *p = build->params;
    if (p->detail < 2) {
        const Vec2 cup[4] = {{0.02f * p->length, -0.16f * p->length},
                             {0.09f * p->length, -0.1f * p->length},
                             {0.1f * p->length, -0.02f * p->length},
                             {0.06f * p->length, 0.02f * p->length}};
        quads_revolve(&build->tissue[TISSUE_GREEN], cup, 4, 5);
        return;
    }
    const Vec2 urn[6] = {
        {0.03f * p->length, -0.36f * p->length}, {0.1f * p->length, -0.3f * p->length},
        {0.12f * p->length, -0.2f * p->length},  {0.1f * p->length, -0.1f * p->length},
        {0.12f * p->length, -0.01f * p->length}, {0.06f * p->length, 0.02f * p->length}};
    quads_revolve(&build->tissue[TISSUE_GREEN], urn, 6, 8);
}

void organ_blossom(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    const Transform *outer = build->tissue[TISSUE_PETAL].place;
    bool closed = organ_is_closed(p, seed);
    float wide = openness(p, seed);
    if (closed) {
        add_closed(build, seed);
    } else {
        add_whorls(build, outer, wide, seed);
    }
    if (p->detail == 0) {
        return;
    }
    if (!closed) {
        add_stamens(build, wide, seed);
    }
    add_urn(build);
    if (p->detail > 1) {
        add_sepals(build, closed ? 14.0f : 30.0f + 105.0f * wide, closed ? 0.6f : 0.2f);
    }
}
