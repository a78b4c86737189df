// Flower heads of the daisy family: one ring of ray florets about a domed disc of many small ones
// in spirals (Vogel, 1979), green bracts below.
#include "base/exact_math.h"
#include "base/random.h"
#include "mesh/organ/organ_parts.h"

enum { STREAM_RAYS = 10 }; // of a head; + number
enum { STREAM_OPEN = 1, STREAM_TURN = 2, STREAM_SIZE = 3 };

enum { BRACTS = 9 };

// A ray floret along +Y: narrow at its base, blunt at its end.
static void add_ray(Quads *quads, float length, float width)
{
    enum { ROWS = 5 };
    static const float share[ROWS] = {0.0f, 0.3f, 0.7f, 0.93f, 1.0f};
    static const float wide[ROWS] = {0.35f, 0.8f, 1.0f, 0.8f, 0.35f};
    float at[ROWS], half[ROWS], lift[ROWS];
    for (int r = 0; r < ROWS; r++) {
        at[r] = length * share[r];
        half[r] = 0.5f * width * wide[r];
        lift[r] = -0.1f * length * share[r] * share[r];
    }
    organ_sheet(quads, at, half, lift, ROWS, 0.15f);
}

static void add_rays(OrganBuild *build, float disc, uint64_t seed)
{
    const OrganParams *p = build->params;
    Quads *quads = &build->tissue[TISSUE_PETAL];
    const Transform *outer = quads->place;
    for (int i = 0; i < p->petals; i++) {
        uint64_t key = random_key(seed, STREAM_RAYS + (uint64_t)i);
        float turn = 360.0f * (float)i / (float)p->petals, sine, cosine;
        turn += random_range(random_key(key, STREAM_TURN), -0.3f, 0.3f) * 360.0f / (float)p->petals;
        float open = 15.0f + 75.0f * p->open;
        open += random_range(random_key(key, STREAM_OPEN), -9.0f, 7.0f);
        exact_sincos(turn * RADIANS_PER_DEGREE, &sine, &cosine);
        Vec3 foot =
            vec3(0.85f * disc * cosine, (i % 2 ? 0.01f : -0.01f) * p->length, 0.85f * disc * sine);
        Transform frame = organ_frame(foot, open, turn);
        Transform place = transform_multiply(outer, &frame);
        quads->place = &place;
        float size = random_range(random_key(key, STREAM_SIZE), 0.85f, 1.05f);
        add_ray(quads, size * p->length, p->width);
        quads->place = outer;
    }
}

// The disc: its dome, and on it at detail 2 the florets as small bumps.
static void add_disc(OrganBuild *build, float disc)
{
    const Vec2 dome[5] = {{disc, 0.0f},
                          {0.97f * disc, 0.16f * disc},
                          {0.75f * disc, 0.34f * disc},
                          {0.4f * disc, 0.43f * disc},
                          {0.0f, 0.45f * disc}};
    Quads *quads = &build->tissue[TISSUE_FLESH];
    const Transform *outer = quads->place;
    quads_revolve(quads, dome, 5, build->params->detail > 1 ? 12 : 8);
    int florets = build->params->detail > 1 ? 90 : 0;
    for (int i = 0; i < florets; i++) {
        float r = disc * sqrtf(((float)i + 0.5f) / (float)florets), sine, cosine;
        exact_sincos((float)i * ORGAN_DIVERGENCE * RADIANS_PER_DEGREE, &sine, &cosine);
        float height = 0.43f * disc * (1.0f - (r / disc) * (r / disc));
        float size = 0.09f * disc;
        const Vec2 bump[3] = {{size, 0.0f}, {0.8f * size, size}, {0.0f, 1.4f * size}};
        Transform frame = organ_frame(vec3(0.95f * r * cosine, height, 0.95f * r * sine),
                                      50.0f * r / disc, (float)i * ORGAN_DIVERGENCE);
        Transform place = transform_multiply(outer, &frame);
        quads->place = &place;
        quads_revolve(quads, bump, 3, 4);
        quads->place = outer;
    }
}

void organ_daisy(OrganBuild *build, uint64_t seed)
{
    const OrganParams *p = build->params;
    float disc = fmaxf(p->dimple, 0.05f) * p->length;
    add_rays(build, disc, seed);
    add_disc(build, disc);
    Quads *green = &build->tissue[TISSUE_GREEN];
    const Transform *outer = green->place;
    const Vec2 cup[4] = {{0.12f * disc, -0.5f * disc},
                         {0.7f * disc, -0.34f * disc},
                         {0.95f * disc, -0.05f * disc},
                         {0.9f * disc, 0.0f}};
    quads_revolve(green, cup, 4, 8);
    for (int i = 0; i < BRACTS && p->detail > 1; i++) {
        Transform frame = organ_frame(vec3(0, -0.3f * disc, 0), 70.0f, 360.0f * (float)i / BRACTS);
        Transform place = transform_multiply(outer, &frame);
        green->place = &place;
        const float at[3] = {0.5f * disc, 0.9f * disc, 1.15f * disc};
        const float half[3] = {0.22f * disc, 0.2f * disc, 0.02f * disc};
        const float lift[3] = {0, 0.04f * disc, 0.1f * disc};
        organ_sheet(green, at, half, lift, 3, 0.2f);
        green->place = outer;
    }
}
