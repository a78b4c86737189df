// Land of beds (base/strata.h). Each bed shows in its own colour wherever the surface meets it,
// with laminae, stains below ledges on faces, rubble from the beds above on talus
// (SurfacePoint.site.y), and soil with shrubs where it is level.
#include "base/strata.h"
#include "render/material/pattern.h"
#include "render/material/pattern_beds.h"
#include "render/material/pattern_crags.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_shore.h"
#include "render/material/pattern_slopes.h"

#include <stddef.h>

enum {
    SEED_FRAY = 305,
    SEED_ROUGH = 310,
    SEED_STREAK = 320,
    SEED_STONES = 330,
    SEED_SOIL = 340,
    SEED_SHRUB = 350
};

static float scale_of(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 36.0f;
}

// Joints cut faces into blocks, which stand out, break off and leave corners in shadow.
static void break_face(const SurfacePoint *point, float size, float steep, Ground *g)
{
    CragsRock face = crags_level(point, size, 0.7f);
    Crags crags = pattern_crags(point, &face);
    float light = (1.0f + 0.14f * crags.tone) * (1.0f - 0.6f * crags.crevice);
    g->color = vec3_scale(g->color, lerpf(1.0f, light, steep));
    g->slope = vec3_madd(g->slope, 0.85f * steep, crags.slope);
}

static Ground rock(const Material *m, const SurfacePoint *point, float level, float steep)
{
    float scale = scale_of(m), footprint = point->footprint;
    PatternOctaves rough = pattern_octaves(point, scale, 8, 0.55f, 1.2f, SEED_ROUGH);
    PatternOctaves streaks = pattern_octaves(point, 1.4f * scale, 6, 0.62f, 0.16f, SEED_STREAK + 8);
    float bent = level + 0.02f * scale * rough.value;
    float tone = beds_lamina_tone(point->strata, bent, footprint, 1.0f);
    Ground g = {.color = beds_mean_color(point->strata, level, footprint)};
    g.color = vec3_scale(g.color, 0.8f + 0.4f * tone);
    g.color = vec3_scale(g.color, clampf(1.0f + 0.2f * rough.value, 0.6f, 1.4f));
    // Desert varnish runs down the faces.
    float stain = steep * smoothstepf(0.1f, 0.7f, streaks.value + 0.2f * rough.value);
    g.color = vec3_lerp(g.color, vec3(0.12f, 0.075f, 0.055f), 0.36f * stain);
    g.slope = vec3_scale(rough.slope, 0.05f * scale);
    g.slope.y += 1.1f * (tone - 0.5f);
    if (steep > 0.0f) {
        break_face(point, 0.5f * scale, steep, &g);
    }
    return g;
}

// Blocks and fines that fell from the beds above.
static Ground rubble(const SurfacePoint *point, float level)
{
    PatternOctaves stones = pattern_octaves(point, 6.0f, 5, 0.65f, 1.0f, SEED_STONES);
    PatternOctaves chutes = pattern_octaves(point, 45.0f, 5, 0.6f, 0.3f, SEED_STONES + 8);
    Vec3 sum = {0};
    for (int i = 0; i < 4; i++) {
        sum = vec3_add(sum, beds_color(point->strata, level + 6.0f + 32.0f * (float)i));
    }
    Ground g = {.color = vec3_scale(sum, 0.25f)};
    g.color = vec3_lerp(g.color, beds_color(point->strata, level), 0.3f);
    g.color =
        vec3_scale(g.color, clampf(0.95f + 0.2f * stones.value + 0.16f * chutes.value, 0.5f, 1.5f));
    g.slope = vec3_madd(vec3_scale(stones.slope, 0.9f), 2.2f, chutes.slope);
    return g;
}

static Ground soil(const Material *m, const SurfacePoint *point, float level)
{
    PatternOctaves sand = pattern_octaves(point, 40.0f, 7, 0.55f, 1.0f, SEED_SOIL);
    Ground g = {.color = vec3_lerp(m->color, beds_color(point->strata, level - 2.0f), 0.5f)};
    g.color = vec3_scale(g.color, clampf(1.0f + 0.16f * sand.value, 0.6f, 1.4f));
    g.slope = vec3_scale(sand.slope, 1.2f);
    return g;
}

// The share of the ground under shrubs.
static float shrubs(const SurfacePoint *point, float density, float size)
{
    PatternOctaves groves = pattern_octaves(point, 220.0f, 5, 0.6f, 1.0f, SEED_SHRUB);
    float grows = clampf(density * (0.8f + 1.3f * groves.value), 0.0f, 1.0f);
    return pattern_mounds(point, grows, size, SEED_SHRUB + 9).share;
}

void pattern_strata(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    if (!point->strata) {
        return;
    }
    float upright = fabsf(surface_smooth_normal(point).y), level = beds_level(point);
    PatternOctaves fray = pattern_octaves(point, 24.0f, 5, 0.6f, 1.0f, SEED_FRAY);
    float steep = 1.0f - smoothstepf(0.45f, 0.72f, upright + 0.06f * fray.value);
    Ground g = rock(m, point, level, steep), other = rubble(point, level);
    float loose = smoothstepf(0.18f, 0.5f, point->site.y + 0.12f * fray.value) *
                  smoothstepf(0.55f, 0.7f, upright + 0.05f * fray.value);
    g.color = vec3_lerp(g.color, other.color, loose);
    g.slope = vec3_lerp(g.slope, other.slope, loose);
    float even = smoothstepf(0.90f, 0.975f, upright + 0.03f * fray.value);
    other = soil(m, point, level);
    g.color = vec3_lerp(g.color, other.color, even);
    g.slope = vec3_lerp(g.slope, other.slope, even);
    float green = shrubs(point, 0.12f * smoothstepf(0.72f, 0.85f, upright) + 0.42f * even, 6.5f);
    g.color = vec3_lerp(g.color, m->color2, green);
    g = pattern_shore(point, vec3_scale(m->color, 0.9f), 1.0f, g);
    shade->color = g.color;
    float bump = m->pattern_depth > 0.0f ? 1.0f - point->displaced : 0.0f;
    shade->normal = pattern_tilt(shade->normal, vec3_scale(g.slope, bump));
}

float pattern_strata_height(const Material *m, const SurfacePoint *point)
{
    if (!point->strata) {
        return 0.0f;
    }
    float upright = fabsf(point->smooth_normal.y);
    float steep = 1.0f - smoothstepf(0.6f, 0.95f, upright);
    float level = beds_level(point);
    PatternOctaves rough = pattern_octaves(point, scale_of(m), 8, 0.5f, 1.2f, SEED_ROUGH);
    PatternOctaves joints =
        pattern_octaves(point, 0.55f * scale_of(m), 6, 0.6f, 0.13f, SEED_STREAK);
    float tone = beds_lamina_tone(point->strata, level, point->footprint, 1.0f) - 0.5f;
    float face = steep * (0.7f * tone - 0.3f * joints.value);
    return m->pattern_depth * (face + (0.04f + 0.2f * steep) * rough.value);
}
