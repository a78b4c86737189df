// Badlands: soft bare beds. Bands of colour fade into each other and under mud that rain has washed
// down from the beds above; runnels, finer than the land's own rills, follow the fall of each wall;
// washes are pale silt. SurfacePoint.site.y: 0 on crests, up to 0.5 in rills, 1 on washes.
#include "base/strata.h"
#include "render/material/pattern.h"
#include "render/material/pattern_beds.h"
#include "render/material/pattern_mix.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

enum {
    SEED_FRAY = 111,
    SEED_RUNNEL = 1201,
    SEED_CRUMB = 127,
    SEED_SILT = 131,
    SEED_SCRUB = 141,
    SEED_VEIL = 145
};

// ---- runnels

enum { WAYS = 8 }; // in half a turn

// Waves of noise across a way in plan, drawn out along it, folded so that they crease where the
// noise is 0: furrows with round ribs between. width: m, of the widest.
static PatternOctaves furrows_along(Vec3 p, Vec3 across, float width, uint32_t seed)
{
    const float length = 7.0f; // of a runnel, in its widths, down the slope
    PatternOctaves sum = {0};
    float height = 1.0f, norm = 0.0f;
    Vec3 along = vec3(-across.z, 0.0f, across.x);
    for (uint32_t k = 0; k < 3; k++, width *= 0.47f, height *= 0.55f) {
        float by = 1.0f / width, down = by / length;
        Vec3 gradient,
            q = vec3(vec3_dot(p, across) * by, 1.4f * p.y * down, vec3_dot(p, along) * down);
        float n = noise_solid(q, seed + k, &gradient), sign = n < 0.0f ? -2.0f : 2.0f;
        sum.value += height * (sign * n - 0.6f);
        Vec3 slope = vec3_scale(across, gradient.x * by);
        slope.y += 1.4f * gradient.y * down;
        slope = vec3_madd(slope, gradient.z * down, along);
        sum.slope = vec3_madd(sum.slope, height * width * sign, slope);
        norm += height;
    }
    sum.value /= norm;
    return sum;
}

// Runnels down the fall of the surface, `width` m apart: about -1 in their beds, 1 on ribs, 0 where
// it is level. slope: of a relief of a width's height.
static PatternOctaves runnels(const SurfacePoint *point, Vec3 normal, float width)
{
    PatternOctaves sum = {0};
    float level = normal.x * normal.x + normal.z * normal.z;
    float shown = smoothstepf(0.04f, 0.2f, level) * pattern_detail(width, point->footprint);
    if (shown <= 0.0f) {
        return sum;
    }
    static const float way[WAYS][2] = {{1.0f, 0.0f},
                                       {0.92387953f, 0.38268343f},
                                       {0.70710678f, 0.70710678f},
                                       {0.38268343f, 0.92387953f},
                                       {0.0f, 1.0f},
                                       {-0.38268343f, 0.92387953f},
                                       {-0.70710678f, 0.70710678f},
                                       {-0.92387953f, 0.38268343f}};
    float by = 1.0f / sqrtf(level), squares = 0.0f;
    for (uint32_t k = 0; k < WAYS; k++) {
        // Of the two ways on both sides of the fall, and no others.
        float along = fabsf(normal.x * way[k][0] + normal.z * way[k][1]) * by;
        float weight = fmaxf(0.0f, (along - 0.92387953f) * (1.0f / 0.07612047f));
        if (weight > 0.0f) {
            Vec3 across = vec3(-way[k][1], 0.0f, way[k][0]);
            PatternOctaves one =
                furrows_along(point->object_position, across, width, SEED_RUNNEL + 16 * k);
            sum.value += weight * one.value;
            sum.slope = vec3_madd(sum.slope, weight, one.slope);
            squares += weight * weight;
        }
    }
    float scale = shown / sqrtf(fmaxf(squares, 1e-6f));
    sum.value *= scale;
    sum.slope = vec3_scale(sum.slope, scale);
    return sum;
}

// ---- beds

// The colour at a level; borders are as soft as a share of a metre that differs from bed to bed.
static Vec3 soft_bed(const Strata *strata, float level, float footprint)
{
    int bed = strata_bed(strata, level);
    Vec3 color = strata->bed[bed].color;
    float floor = strata->floor[bed], top = bed > 0 ? strata->floor[bed - 1] : 0.0f;
    float thick = bed > 0 && bed < strata->bed_count - 1 ? top - floor : 1e6f;
    for (int side = 0; side < 2; side++) {
        int next = side == 0 ? bed - 1 : bed + 1;
        if (next < 0 || next >= strata->bed_count) {
            continue;
        }
        int border = side == 0 ? bed : bed + 1;
        float softness = noise_unit(2654435761u * (uint32_t)border, 5);
        float soft = 0.1f + 1.5f * softness * softness + 0.5f * footprint;
        soft = fminf(soft, 0.49f * thick);
        float away = side == 0 ? top - level : level - floor;
        float share = fminf(smoothstepf(soft, -soft, away), 0.5f);
        color = vec3_lerp(color, strata->bed[next].color, share);
    }
    return color;
}

// The phase of a level within beds of this thickness, gently folded.
static float own_level(const SurfacePoint *point, float thickness)
{
    Vec3 p = point->object_position, q = vec3_scale(p, 0.11f / thickness);
    float fold =
        1.8f * noise_solid(vec3_scale(q, 0.12f), 51, NULL) + 0.35f * noise_solid(q, 52, NULL);
    return (0.05f * p.x + p.y + 0.03f * p.z) / thickness + fold;
}

static float own_tone(float level, uint32_t seed)
{
    float floor_level = floorf(level), t = level - floor_level;
    uint32_t bed = (uint32_t)(int32_t)floor_level * 2654435761u + seed;
    float soft = 0.9f - 0.6f * noise_unit(bed, 4);
    return lerpf(noise_unit(bed, 3), noise_unit(bed + 2654435761u, 3), smoothstepf(soft, 1.0f, t));
}

// Bands of the material's colours, where the land has no beds.
static Vec3 own_bed(const Material *m, const SurfacePoint *point, Vec3 base, float rough)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 40.0f;
    float level = own_level(point, scale) + 0.05f * rough, tone = own_tone(level, 11);
    tone = lerpf(tone, own_tone(3.7f * level, 13),
                 0.45f * pattern_detail(0.3f * scale, point->footprint));
    Vec3 pale = {0.47f, 0.36f, 0.25f}, dark = {0.16f, 0.065f, 0.043f};
    Vec3 color = vec3_lerp(base, m->color2, smoothstepf(0.25f, 0.55f, tone));
    color = vec3_lerp(color, pale, smoothstepf(0.66f, 0.86f, tone));
    return vec3_lerp(color, dark, 0.75f * smoothstepf(0.24f, 0.08f, tone));
}

// ---- walls and washes

static Ground wall(const Material *m, const SurfacePoint *point, Vec3 base, float scale)
{
    const Strata *strata = point->strata;
    PatternOctaves rough = pattern_octaves(point, 0.5f * scale, 8, 0.54f, 1.3f, SEED_FRAY);
    PatternOctaves crumbs = pattern_octaves(point, 0.012f * scale, 3, 0.7f, 1.0f, SEED_CRUMB);
    PatternOctaves veil = pattern_octaves(point, 2.2f * scale, 5, 0.6f, 0.6f, SEED_VEIL);
    PatternOctaves run = runnels(point, surface_smooth_normal(point), 0.07f * scale);
    Vec3 p = point->object_position, color, mud = vec3_lerp(base, m->color2, 0.5f);
    if (strata) {
        float level = p.y - strata_base(strata, p.x, p.z) + 0.016f * scale * rough.value +
                      0.05f * scale * veil.value;
        color = soft_bed(strata, level, point->footprint);
        Vec3 above = vec3_add(beds_mean_color(strata, level + 0.1f * scale, 0.2f * scale),
                              beds_mean_color(strata, level + 0.3f * scale, 0.4f * scale));
        mud = vec3_lerp(mud, vec3_scale(above, 0.5f), 0.5f);
    } else {
        color = own_bed(m, point, base, rough.value);
    }
    float gully = smoothstepf(0.05f, 0.45f, point->site.y);
    float washed = 0.24f + 0.6f * veil.value - 0.2f * run.value + 0.35f * gully;
    color = vec3_lerp(color, mud, clampf(washed, 0.04f, 0.85f));
    float light = 1.0f + 0.1f * rough.value + 0.08f * run.value + 0.1f * crumbs.value;
    Ground g = {.color = vec3_scale(color, clampf(light, 0.5f, 1.4f))};
    g.slope = vec3_scale(rough.slope, 0.02f * scale);
    g.slope = vec3_madd(g.slope, 0.55f, run.slope);
    g.slope = vec3_madd(g.slope, 0.0035f * scale, crumbs.slope);
    return g;
}

static Ground silt(const Material *m, const SurfacePoint *point, Vec3 base, float scale)
{
    PatternOctaves sand = pattern_octaves(point, 0.3f * scale, 7, 0.55f, 1.0f, SEED_SILT);
    PatternOctaves broad = pattern_octaves(point, 1.3f * scale, 3, 0.5f, 1.0f, SEED_SILT + 8);
    Vec3 mean = point->strata ? point->strata->mean_color : vec3_lerp(base, m->color2, 0.5f);
    Ground g = {.color = vec3_lerp(mean, vec3(0.50f, 0.42f, 0.32f), 0.6f)};
    float light = 1.0f + 0.1f * clampf(sand.value, -1.3f, 1.3f) + 0.12f * broad.value;
    g.color = vec3_scale(g.color, light);
    float scrub = pattern_octaves(point, 0.09f * scale, 3, 0.7f, 1.0f, SEED_SCRUB).value;
    scrub = smoothstepf(0.42f, 0.65f, scrub + 0.35f * broad.value);
    g.color = vec3_lerp(g.color, vec3(0.12f, 0.115f, 0.065f), 0.55f * scrub);
    g.slope = vec3_scale(sand.slope, 0.012f * scale);
    return g;
}

void pattern_badlands(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 40.0f;
    float upright = fabsf(surface_smooth_normal(point).y);
    float fray = pattern_octaves(point, 0.12f * scale, 4, 0.6f, 1.0f, SEED_SILT + 16).value;
    Ground g = wall(m, point, shade->color, scale), floor = silt(m, point, shade->color, scale);
    float flat = smoothstepf(0.55f, 0.85f, point->site.y + 0.08f * fray) *
                 smoothstepf(0.90f, 0.97f, upright + 0.03f * fray);
    g = ground_blend(g, &floor, flat);
    shade->color = g.color;
    shade->normal = pattern_tilt(shade->normal, vec3_scale(g.slope, m->pattern_depth));
}
