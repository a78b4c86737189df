// Tower karst: grey limestone in beds, with joints and karren, dark and rusty streaks where water
// runs down, a dark damp foot; bushes wherever it is not sheer; fields on the plain. site.x is km
// above the water table; site.y is how loose the ground is, 0 on rock.
#include "base/strata.h"
#include "render/material/pattern.h"
#include "render/material/pattern_crags.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_shore.h"

#include <stddef.h>

enum {
    SEED_PATCH = 601,
    SEED_ROCK = 611,
    SEED_STREAK = 631,
    SEED_BUSH = 651,
    SEED_FIELD = 671,
    SEED_FLUTE = 691
};

// Dark films of algae where water runs, pale tufa and rust beside them.
static Vec3 stain(const SurfacePoint *point, Vec3 color, float patch)
{
    float dark = pattern_streaks(point, 9.0f);
    float rust = smoothstepf(0.15f, 0.6f, 0.7f * patch - 0.6f * dark);
    color = vec3_lerp(color, vec3(0.30f, 0.21f, 0.115f), 0.48f * rust);
    return vec3_lerp(color, vec3(0.055f, 0.056f, 0.055f), 0.85f * dark);
}

// Runnels that the rain has dissolved down steep faces, side by side with sharp ribs between them
// (rillenkarren, and larger). groove: 0..1 in the bottom of one.
static PatternOctaves flutes(const SurfacePoint *point, float *groove)
{
    PatternOctaves wide = pattern_octaves(point, 13.0f, 4, 0.7f, 0.05f, SEED_FLUTE);
    float steep = smoothstepf(0.6f, 0.35f, fabsf(surface_smooth_normal(point).y));
    *groove = steep * (1.0f - smoothstepf(0.0f, 0.3f, fabsf(wide.value)));
    wide.slope = vec3_scale(wide.slope, wide.value < 0.0f ? -steep : steep);
    return wide;
}

static CragsRock face_of(const SurfacePoint *point)
{
    return crags_level(point, KARST_BLOCKS, 1.1f);
}

float pattern_karst_height(const Material *m, const SurfacePoint *point)
{
    CragsRock face = face_of(point);
    return m->pattern_depth * crags_height(point, &face, 0.8f, 0.5f);
}

// ledges: the share of the place that soil on ledges takes, and in cracks.
static Ground rock(const SurfacePoint *point, float patch, float *ledges)
{
    PatternOctaves rough = pattern_octaves(point, 3.0f, 7, 0.6f, 0.7f, SEED_ROCK);
    PatternOctaves karren = pattern_octaves(point, 1.6f, 5, 0.6f, 0.12f, SEED_ROCK + 9);
    CragsRock face = face_of(point);
    Vec3 color = {0.31f, 0.30f, 0.28f};
    float tone = 0.5f;
    if (point->strata) {
        float level = face.level + 1.2f * patch;
        int bed = strata_bed(point->strata, level);
        float thick = fmaxf(point->strata->bed[bed].lamina, 0.4f);
        color = point->strata->bed[bed].color;
        tone = pattern_lamina(level, thick, point->footprint, 0.6f, 7919u * (uint32_t)bed);
    }
    Crags crags = pattern_crags(point, &face);
    *ledges = fmaxf(crags.ledge, 0.8f * crags.crevice);
    float groove;
    PatternOctaves runnels = flutes(point, &groove);
    color = stain(point, color, patch);
    float light = 1.0f + 0.25f * (tone - 0.5f) + 0.15f * crags.tone + 0.12f * rough.value;
    light *= (1.0f - 0.7f * crags.crevice) * (1.0f - 0.4f * groove);
    Ground g = {.color = vec3_scale(color, clampf(light, 0.3f, 1.6f))};
    g.slope = vec3_madd(vec3_scale(rough.slope, 0.1f), 0.9f, crags.slope);
    g.slope = vec3_madd(g.slope, 0.12f, karren.slope);
    g.slope = vec3_madd(g.slope, 1.1f, runnels.slope);
    g.slope.y += 0.6f * (tone - 0.5f);
    return g;
}

static Ground bushes(const Material *m, const SurfacePoint *point, float patch)
{
    PatternOctaves crown = pattern_octaves(point, 5.0f, 5, 0.6f, 1.0f, SEED_BUSH);
    PatternOctaves leaf = pattern_octaves(point, 0.8f, 4, 0.65f, 1.0f, SEED_BUSH + 9);
    Vec3 dry = {0.105f, 0.098f, 0.036f};
    float light = 1.0f + 0.55f * crown.value + 0.25f * leaf.value;
    Ground g = {.color = vec3_lerp(m->color, dry, 0.5f * smoothstepf(-0.2f, 0.8f, patch))};
    g.color = vec3_scale(g.color, clampf(light, 0.25f, 1.8f));
    g.slope = vec3_madd(vec3_scale(crown.slope, 1.1f), 0.25f, leaf.slope);
    return g;
}

static Ground fields(const Material *m, const SurfacePoint *point, float patch)
{
    PatternOctaves sward = pattern_octaves(point, 14.0f, 5, 0.6f, 1.0f, SEED_FIELD);
    PatternOctaves tufts = pattern_octaves(point, 0.6f, 4, 0.65f, 1.0f, SEED_FIELD + 9);
    Vec3 straw = {0.19f, 0.165f, 0.075f};
    float old = smoothstepf(-0.3f, 0.7f, sward.value + 0.6f * patch);
    Ground g = {.color = vec3_lerp(m->color2, straw, 0.5f * old)};
    g.color = vec3_scale(g.color, clampf(1.0f + 0.25f * tufts.value, 0.5f, 1.5f));
    g.slope = vec3_scale(tufts.slope, 0.08f);
    return g;
}

void pattern_karst(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float patch = pattern_octaves(point, 34.0f, 6, 0.6f, 1.0f, SEED_PATCH).value;
    float fine = pattern_octaves(point, 4.0f, 5, 0.65f, 1.0f, SEED_PATCH + 9).value;
    float upright = fabsf(surface_smooth_normal(point).y);
    float above = 1000.0f * point->site.x;
    float ledges;
    Ground g = rock(point, patch, &ledges);
    // The foot is damp and dark.
    float damp = smoothstepf(9.0f, 2.0f, above + 2.5f * patch);
    g.color = vec3_scale(g.color, 1.0f - 0.45f * damp);
    Ground other = bushes(m, point, patch);
    float holds = upright + 0.26f * patch + 0.20f * fine + 0.3f * ledges;
    g = ground_blend(g, &other, smoothstepf(0.22f, 0.36f, holds));
    other = fields(m, point, patch);
    float loose = smoothstepf(0.2f, 0.6f, point->site.y) * smoothstepf(0.8f, 0.93f, upright);
    g = ground_blend(g, &other, loose);
    g = pattern_shore(point, vec3(0.29f, 0.28f, 0.26f), m->pattern_depth, g);
    shade->color = g.color;
    shade->normal = crags_normal(point, shade->normal, vec3_scale(g.slope, m->pattern_depth));
}
