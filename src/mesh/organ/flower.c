// Blossom: whorls of petals about a centre of stamens, with sepals below.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_PETALS = 10, STREAM_STAMENS = 200 }; // of a flower; + number
enum { STREAM_OPEN = 1, STREAM_ROLL = 2, STREAM_LENGTH = 3 };

enum { PETALS_OF_WHORL = 5, SEPALS = 5, ROWS = 6 };

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

static void add_whorls(OrganBuild *build, const Transform *outer, uint64_t seed)
{
    const OrganParams *p = build->params;
    int petals = p->petals > 0 ? p->petals : PETALS_OF_WHORL;
    int whorls = (petals + PETALS_OF_WHORL - 1) / PETALS_OF_WHORL;
    int each = (petals + whorls - 1) / whorls;
    for (int i = 0; i < petals; i++) {
        uint64_t key = random_key(seed, STREAM_PETALS + (uint64_t)i);
        int whorl = i / each;
        float inner = whorls > 1 ? (float)whorl / (float)(whorls - 1) : 0.0f;
        float open = 12.0f + p->open * lerpf(66.0f, 20.0f, inner) +
                     random_range(random_key(key, STREAM_OPEN), -7.0f, 7.0f);
        float turn = 360.0f * ((float)i + 0.5f * (float)whorl) / (float)each +
                     random_range(random_key(key, STREAM_ROLL), -5.0f, 5.0f);
        Transform frame = organ_frame(vec3(0, 0.02f * p->length * (float)whorl, 0), open, turn);
        Transform place = transform_multiply(outer, &frame);
        Quads *quads = &build->tissue[TISSUE_PETAL];
        quads->place = &place;
        float size = 1.0f - 0.3f * inner;
        float cup = 0.35f - 0.2f * p->open;
        if (p->detail > 0) {
            add_petal(quads, size * p->length, size * p->width, cup, key);
        } else {
            add_plain_petal(quads, size * p->length, size * p->width, cup);
        }
        quads->place = outer;
    }
}

static void add_stamens(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    int stamens = p->detail > 1 ? 18 : 6;
    for (int i = 0; i < stamens && p->open > 0.25f; i++) {
        uint64_t key = random_key(seed, STREAM_STAMENS + (uint64_t)i);
        float open = 45.0f * sqrtf(((float)i + 0.5f) / (float)stamens);
        float length = p->length * random_range(random_key(key, STREAM_LENGTH), 0.4f, 0.6f);
        Transform frame = organ_frame(vec3(0, 0, 0), open, (float)i * ORGAN_DIVERGENCE);
        enum { POINTS = 4 };
        static const float share[POINTS] = {0.0f, 0.88f, 0.94f, 1.0f};
        static const float thick[POINTS] = {0.012f, 0.009f, 0.035f, 0.01f};
        Vec3 axis[POINTS];
        float radius[POINTS];
        for (int k = 0; k < POINTS; k++) {
            axis[k] = transform_point(&frame, vec3(0, share[k] * length, 0));
            radius[k] = thick[k] * p->length;
        }
        quads_tube(&build->tissue[TISSUE_GREEN], axis, radius, POINTS, 3, (Vec2){0.5f, 1.0f});
    }
}

void organ_blossom(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    const Transform *outer = build->tissue[TISSUE_PETAL].place;
    add_whorls(build, outer, seed);
    if (p->detail == 0) {
        return;
    }
    add_stamens(build, seed);
    // The cup below, and sepals.
    const Vec2 cup[4] = {{0.02f * p->length, -0.16f * p->length},
                         {0.09f * p->length, -0.1f * p->length},
                         {0.1f * p->length, -0.02f * p->length},
                         {0.06f * p->length, 0.02f * p->length}};
    Quads *green = &build->tissue[TISSUE_GREEN];
    quads_revolve(green, cup, 4, 5);
    for (int i = 0; i < SEPALS && p->detail > 1; i++) {
        Transform frame = organ_frame(vec3(0, -0.03f * p->length, 0), 40.0f + 55.0f * p->open,
                                      360.0f * ((float)i + 0.5f) / SEPALS);
        Transform place = transform_multiply(outer, &frame);
        green->place = &place;
        const float at[3] = {0.05f * p->length, 0.25f * p->length, 0.45f * p->length};
        const float half[3] = {0.06f * p->length, 0.07f * p->length, 0.01f * p->length};
        const float lift[3] = {0, 0, 0};
        organ_sheet(green, at, half, lift, 3, 0.2f);
        green->place = outer;
    }
}
