// A rocky coast: cliffs in the colours of their beds (base/strata.h), cut by joints into blocks;
// weed, barnacles and wet rock between low and high water, black and orange lichens above, turf
// where the land is not steep, sand that is dark where the sea has just left it. site.x is km above
// the sea; site.y is how loose the ground is. pattern_scale is the tide, m.
#include "base/strata.h"
#include "render/material/pattern.h"
#include "render/material/pattern_crags.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

enum { SEED_FRAY = 401, SEED_BED = 411, SEED_LICHEN = 421, SEED_SAND = 431, SEED_TURF = 441 };

typedef struct Place {
    const Material *material;
    const SurfacePoint *point;
    float above;   // m over the sea
    float high;    // m: high water
    float upright; // of the smooth normal
    float fray;    // noise of tens of metres, about -1..1
    float fine;    // of metres
} Place;

// ---- rock

static Vec3 bed_color(const Strata *strata, float level)
{
    return strata->bed[strata_bed(strata, level)].color;
}

static CragsRock face_of(const SurfacePoint *point)
{
    return crags_level(point, COAST_BLOCKS, 0.5f);
}

float pattern_coast_height(const Material *m, const SurfacePoint *point)
{
    CragsRock face = face_of(point);
    return m->pattern_depth * crags_height(point, &face, 0.9f, 0.7f);
}

// ledges: the share of the place that soil on ledges takes.
static Ground rock(const Place *p, float *ledges)
{
    const SurfacePoint *point = p->point;
    const Strata *strata = point->strata;
    PatternOctaves rough = pattern_octaves(point, 1.6f, 7, 0.6f, 1.0f, SEED_BED);
    Vec3 color = {0.2f, 0.17f, 0.14f};
    float tone = 0.5f;
    CragsRock face = face_of(point);
    if (strata) {
        float level = face.level + 0.35f * p->fray + 0.1f * rough.value;
        float foot = 0.3f * point->footprint;
        color = vec3_scale(
            vec3_add(bed_color(strata, level - foot), bed_color(strata, level + foot)), 0.5f);
        int number = strata_bed(strata, level);
        float thick = fmaxf(strata->bed[number].lamina, 0.2f);
        uint32_t seed = 7919u * (uint32_t)number;
        tone = 0.6f * pattern_lamina(level, thick, point->footprint, 0.8f, seed) +
               0.4f * pattern_lamina(level, 0.24f * thick, point->footprint, 0.8f, seed + 5);
    }
    Crags crags = pattern_crags(point, &face);
    *ledges = crags.ledge;
    float light = 1.0f + 0.5f * (tone - 0.5f) + 0.14f * crags.tone + 0.12f * rough.value;
    light *= (1.0f - 0.7f * crags.crevice) * (1.0f - 0.45f * pattern_streaks(point, 7.0f));
    Ground g = {.color = vec3_scale(color, clampf(light, 0.25f, 1.7f))};
    g.slope = vec3_madd(vec3_scale(rough.slope, 0.05f), 0.9f, crags.slope);
    g.slope.y += 0.6f * (tone - 0.5f);
    return g;
}

// What grows on rock by its height above the water, and how wet it is.
static void grow_bands(const Place *p, Ground *g)
{
    float above = p->above - 0.35f * p->fray - 0.25f * p->fine;
    float half = p->high;
    PatternOctaves spots = pattern_octaves(p->point, 1.2f, 5, 0.65f, 1.0f, SEED_LICHEN);
    // Yellow and grey lichens of the spray zone.
    float spray = smoothstepf(half + 2.0f, half + 4.5f, above) *
                  smoothstepf(half + 22.0f, half + 9.0f, above);
    float orange = spray * smoothstepf(0.18f, 0.5f, spots.value + 0.25f * p->fray);
    g->color = vec3_lerp(g->color, vec3(0.34f, 0.215f, 0.060f), 0.5f * orange);
    float grey = smoothstepf(half + 5.0f, half + 12.0f, above) *
                 smoothstepf(0.05f, 0.45f, 0.5f * p->fray - spots.value);
    g->color = vec3_lerp(g->color, vec3(0.27f, 0.275f, 0.245f), 0.42f * grey);
    // The black band of lichens and blue-green algae at the high-water mark.
    float black =
        smoothstepf(half - 0.5f, half + 0.2f, above) * smoothstepf(half + 3.2f, half + 1.2f, above);
    g->color = vec3_lerp(g->color, vec3(0.022f, 0.021f, 0.020f), 0.82f * black);
    // Barnacles and limpets on the upper shore, wrack below.
    float barnacles = smoothstepf(-0.1f * half, 0.3f * half, above) *
                      smoothstepf(half + 0.1f, 0.7f * half, above);
    float pale = 0.5f + 0.5f * clampf(2.0f * spots.value, -1.0f, 1.0f);
    g->color = vec3_lerp(g->color, vec3(0.19f, 0.18f, 0.155f), 0.55f * barnacles * pale);
    float weed = smoothstepf(0.35f * half, -0.15f * half, above) *
                 smoothstepf(-0.5f, 0.1f, spots.value + 0.4f * p->fine);
    g->color = vec3_lerp(g->color, vec3(0.052f, 0.042f, 0.014f), 0.85f * weed);
    // Wet rock is dark: always where waves reach, above it where spray has run down in streaks.
    float run = pattern_streaks(p->point, 2.5f);
    float wet = smoothstepf(half + 2.2f + 4.0f * run + 0.8f * spots.value, 0.3f * half, above);
    g->color = vec3_scale(g->color, 1.0f - 0.55f * wet);
}

// ---- loose ground and plants

static Ground sand(const Place *p)
{
    const Material *m = p->material;
    PatternOctaves broad = pattern_octaves(p->point, 16.0f, 5, 0.6f, 1.0f, SEED_SAND);
    PatternOctaves grain = pattern_octaves(p->point, 0.35f, 4, 0.6f, 1.0f, SEED_SAND + 10);
    float above = p->above - 0.22f * broad.value;
    Ground g = {.color = vec3_scale(m->color2, 1.0f + 0.09f * broad.value + 0.10f * grain.value)};
    // Drift weed and pebbles along the last high water.
    float line = above - 0.9f * p->high;
    float wrack = smoothstepf(0.16f, 0.03f, fabsf(line)) *
                  smoothstepf(-0.1f, 0.4f, grain.value + 0.6f * p->fine);
    g.color = vec3_lerp(g.color, vec3(0.05f, 0.042f, 0.030f), 0.8f * wrack);
    float wet = smoothstepf(0.55f * p->high, -0.1f * p->high, above);
    g.color = vec3_scale(g.color, 1.0f - 0.5f * wet);
    g.slope = vec3_madd(vec3_scale(broad.slope, 0.10f), 0.012f, grain.slope);
    g.slope = vec3_scale(g.slope, 1.0f - 0.6f * wet);
    return g;
}

static Ground turf(const Place *p)
{
    const Material *m = p->material;
    PatternOctaves sward = pattern_octaves(p->point, 7.0f, 5, 0.65f, 1.0f, SEED_TURF);
    PatternOctaves tufts = pattern_octaves(p->point, 0.7f, 5, 0.65f, 0.8f, SEED_TURF + 10);
    Vec3 dry = {0.165f, 0.140f, 0.062f}, heath = {0.050f, 0.044f, 0.030f};
    float old = smoothstepf(-0.2f, 0.9f, sward.value + 0.4f * tufts.value + 0.3f * p->fray);
    Ground g = {.color = vec3_lerp(m->color, dry, 0.65f * old)};
    float brown = smoothstepf(0.25f, 0.6f, p->fray - 0.5f * sward.value);
    g.color = vec3_lerp(g.color, heath, 0.55f * brown);
    g.color = vec3_scale(g.color, clampf(1.0f + 0.28f * tufts.value, 0.5f, 1.5f));
    g.slope = vec3_madd(vec3_scale(sward.slope, 0.25f), 0.10f, tufts.slope);
    return g;
}

// Fallen blocks at the cliff's foot, and soil on slopes.
static Ground rubble(const Place *p, const Ground *from)
{
    PatternOctaves stones = pattern_octaves(p->point, 2.2f, 6, 0.7f, 1.0f, SEED_SAND + 20);
    Ground g = {.color = vec3_scale(from->color, clampf(0.9f + 0.3f * stones.value, 0.4f, 1.5f))};
    g.slope = vec3_scale(stones.slope, 0.4f);
    return g;
}

void pattern_coast(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    Place p = {.material = m,
               .point = point,
               .above = 1000.0f * point->site.x,
               .high = 0.5f * (m->pattern_scale > 0.0f ? m->pattern_scale : 3.0f),
               .upright = fabsf(surface_smooth_normal(point).y),
               .fray = pattern_octaves(point, 26.0f, 5, 0.6f, 1.0f, SEED_FRAY).value,
               .fine = pattern_octaves(point, 3.0f, 5, 0.6f, 1.0f, SEED_FRAY + 8).value};
    float ledges;
    Ground g = rock(&p, &ledges), other;
    float loose = point->site.y + 0.08f * p.fine;
    float low = smoothstepf(p.high + 3.5f, p.high + 2.0f, p.above + 0.5f * p.fray);
    other = rubble(&p, &g);
    g = ground_blend(g, &other, smoothstepf(0.15f, 0.4f, loose) * (1.0f - low));
    grow_bands(&p, &g);
    other = sand(&p);
    g = ground_blend(g, &other,
                     low * smoothstepf(0.04f, 0.22f, loose) *
                         smoothstepf(0.80f, 0.92f, p.upright + 0.03f * p.fine));
    // Turf holds on ledges, too; salt spray keeps it off the foot.
    float stands = p.upright + 0.09f * p.fine + 0.06f * p.fray + 0.4f * ledges;
    float green = smoothstepf(0.66f, 0.80f, stands) *
                  smoothstepf(p.high + 4.0f, p.high + 9.0f, p.above + 2.0f * p.fray);
    other = turf(&p);
    g = ground_blend(g, &other, green);
    shade->color = g.color;
    shade->normal = crags_normal(point, shade->normal, vec3_scale(g.slope, m->pattern_depth));
}
