#include "render/material/pattern.h"

#include "render/material/pattern_noise.h"

#include <stddef.h>

Vec3 pattern_tilt(Vec3 n, Vec3 slope)
{
    slope = vec3_madd(slope, -vec3_dot(slope, n), n);
    float length = vec3_length(slope);
    const float most = 1.6f;
    return vec3_normalize(vec3_madd(n, -1.0f / (1.0f + length / most), slope));
}

Vec3 pattern_slope(const Material *m, const SurfacePoint *point,
                   float (*height)(const Material *, const SurfacePoint *, Vec3 p), float step)
{
    Vec3 p = point->object_position;
    step = fmaxf(0.25f * point->footprint, step);
    float here = height(m, point, p);
    Vec3 ahead = {height(m, point, vec3_add(p, vec3(step, 0, 0))),
                  height(m, point, vec3_add(p, vec3(0, step, 0))),
                  height(m, point, vec3_add(p, vec3(0, 0, step)))};
    return vec3_scale(vec3_sub(ahead, vec3_splat(here)), 1.0f / step);
}

SurfacePoint pattern_coarse_point(const SurfacePoint *point)
{
    SurfacePoint coarse = *point;
    coarse.footprint *= fmaxf(1.0f, point->coarsening);
    return coarse;
}

Vec3 pattern_bump(const Material *m, const SurfacePoint *point,
                  float (*height)(const Material *, const SurfacePoint *, Vec3 p), float step)
{
    if (point->displaced >= 1.0f && point->coarsening <= 1.0f) {
        return vec3_splat(0.0f);
    }
    Vec3 slope = pattern_slope(m, point, height, step), shown = slope;
    if (point->displaced > 0.0f && point->coarsening > 1.0f) {
        SurfacePoint coarse = pattern_coarse_point(point);
        shown = pattern_slope(m, &coarse, height, step);
    }
    return vec3_madd(slope, -point->displaced, shown);
}

float pattern_detail(float wavelength, float footprint)
{
    return 1.0f - smoothstepf(0.25f, 1.0f, footprint / wavelength);
}

float pattern_lamina(float level, float thickness, float footprint, float soft, uint32_t seed)
{
    float seen = pattern_detail(2.0f * thickness, footprint);
    if (seen <= 0.0f) {
        return 0.5f;
    }
    float at = level / thickness, whole = floorf(at);
    uint32_t layer = (uint32_t)(int32_t)whole * 2654435761u + seed;
    float tone = lerpf(noise_unit(layer, 3), noise_unit(layer + 2654435761u, 3),
                       smoothstepf(soft, 1.0f, at - whole));
    return lerpf(0.5f, tone, seen);
}

PatternOctaves pattern_octaves(const SurfacePoint *point, float wavelength, int octaves, float gain,
                               float squash, uint32_t seed)
{
    PatternOctaves sum = {0};
    float height = 1.0f;
    for (int i = 0; i < octaves; i++) {
        float seen = pattern_detail(wavelength, point->footprint);
        if (seen <= 0.0f) {
            break;
        }
        Vec3 p = vec3_scale(point->object_position, 1.0f / wavelength), slope;
        p.y *= squash;
        float n = noise_solid(p, seed + (uint32_t)i, &slope);
        slope.y *= squash;
        sum.value += seen * height * n;
        sum.slope = vec3_madd(sum.slope, seen * height / wavelength, slope);
        wavelength *= 0.47f;
        height *= gain;
    }
    return sum;
}

// Shifts the hue between green-blue and red and scales the value, per instance.
static Vec3 vary(Vec3 color, float variation, float value, float hue)
{
    float v = 1.0f + 0.7f * variation * (value - 0.5f);
    float h = variation * (hue - 0.5f);
    return vec3(color.x * v * (1.0f + 0.8f * h), color.y * v, color.z * v * (1.0f - 0.5f * h));
}

Vec3 pattern_color_ratio(Vec3 from, Vec3 to)
{
    const Vec3 least = {1e-3f, 1e-3f, 1e-3f};
    from = vec3_max(from, least);
    to = vec3_max(to, least);
    return vec3(to.x / from.x, to.y / from.y, to.z / from.z);
}

static void noise_pattern(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.1f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale), gradient;
    float large = noise_solid(p, 1, &gradient);
    float small =
        noise_fractal(vec3_scale(p, 2.0f), 3, 2) * pattern_detail(0.25f * scale, point->footprint);
    float t = clampf(0.5f + 0.5f * large + 0.4f * small, 0.0f, 1.0f);
    if (m->kind == MATERIAL_LEAF) { // what reflects otherwise transmits otherwise
        Vec3 mixed = vec3_lerp(shade->color, m->color2, t);
        shade->transmittance =
            vec3_mul(shade->transmittance, pattern_color_ratio(shade->color, mixed));
    }
    shade->color = vec3_lerp(shade->color, m->color2, t);
    float depth = m->pattern_depth * pattern_detail(scale, point->footprint);
    float bump = 0.5f * depth / scale * (1.0f - point->displaced);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(gradient, bump));
}

// With smaller octaves, of sharp crests, which bumps leave out.
static float noise_height(const Material *m, const SurfacePoint *point)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.1f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale);
    float n = noise_solid(p, 1, NULL), height = 0.9f;
    for (uint32_t octave = 0; octave < 6; octave++) {
        p = vec3_scale(p, 2.03f);
        n += height * (0.3f - fabsf(noise_solid(p, 5 + octave, NULL)));
        height *= 0.48f;
    }
    return 0.5f * m->pattern_depth * pattern_detail(scale, point->footprint) * n;
}

bool pattern_varies_roughness(const Material *m)
{
    return m->pattern == PATTERN_ICE && m->kind == MATERIAL_PRINCIPLED;
}

float pattern_height(const Material *m, const SurfacePoint *point)
{
    switch (m->pattern) {
    case PATTERN_BARK:
        return pattern_bark_height(m, point);
    case PATTERN_MASONRY:
    case PATTERN_DRESSED:
        return pattern_masonry_height(m, point);
    case PATTERN_RUBBLE:
        return pattern_rubble_height(m, point);
    case PATTERN_STONE:
        return pattern_stone_height(m, point);
    case PATTERN_STRATA:
        return pattern_strata_height(m, point);
    case PATTERN_BADLANDS:
        return pattern_badlands_height(m, point);
    case PATTERN_SNOW:
        return pattern_snow_height(m, point);
    case PATTERN_NOISE:
        return noise_height(m, point);
    case PATTERN_MOUNTAIN:
        return pattern_mountain_height(m, point);
    case PATTERN_ALPS:
        return pattern_alps_height(m, point);
    case PATTERN_COAST:
        return pattern_coast_height(m, point);
    case PATTERN_KARST:
        return pattern_karst_height(m, point);
    default:
        return 0.0f;
    }
}

float pattern_height_size(const Material *m)
{
    const float faces = 0.1f; // of the size of their blocks
    switch (m->pattern) {
    case PATTERN_MOUNTAIN:
        return faces * pattern_mountain_blocks(m) * m->pattern_depth;
    case PATTERN_ALPS:
        return faces * pattern_alps_blocks(m) * m->pattern_depth;
    case PATTERN_COAST:
        return faces * COAST_BLOCKS * m->pattern_depth;
    case PATTERN_KARST:
        return faces * KARST_BLOCKS * m->pattern_depth;
    default:
        return m->pattern_depth;
    }
}

static void (*const APPLY[])(const Material *, const SurfacePoint *, PatternShade *) = {
    [PATTERN_BARK] = pattern_bark,         [PATTERN_MASONRY] = pattern_masonry,
    [PATTERN_DRESSED] = pattern_masonry,   [PATTERN_RUBBLE] = pattern_rubble,
    [PATTERN_STONE] = pattern_stone,       [PATTERN_GROUND] = pattern_ground,
    [PATTERN_LEAF] = pattern_leaf,         [PATTERN_CORALLITE] = pattern_corallite,
    [PATTERN_REEF] = pattern_reef,         [PATTERN_YOUTH] = pattern_youth,
    [PATTERN_BRAIN] = pattern_brain,       [PATTERN_SAND] = pattern_sand,
    [PATTERN_MOUNTAIN] = pattern_mountain, [PATTERN_BADLANDS] = pattern_badlands,
    [PATTERN_WATER] = pattern_water,       [PATTERN_ALTITUDE] = pattern_altitude,
    [PATTERN_ALPS] = pattern_alps,         [PATTERN_VOLCANO] = pattern_volcano,
    [PATTERN_STRATA] = pattern_strata,     [PATTERN_DUNES] = pattern_dunes,
    [PATTERN_HILLS] = pattern_hills,       [PATTERN_COAST] = pattern_coast,
    [PATTERN_BRAIDED] = pattern_braided,   [PATTERN_GLACIAL] = pattern_glacial,
    [PATTERN_NOISE] = noise_pattern,       [PATTERN_KARST] = pattern_karst,
    [PATTERN_MUD] = pattern_mud,           [PATTERN_FLOODPLAIN] = pattern_floodplain,
    [PATTERN_RIVER] = pattern_river,       [PATTERN_DELTA] = pattern_delta,
    [PATTERN_SILT] = pattern_silt,         [PATTERN_HEATH] = pattern_heath,
    [PATTERN_ICE] = pattern_ice,           [PATTERN_SNOW] = pattern_snow,
    [PATTERN_WOOD] = pattern_wood,
};

void pattern_apply(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    if (m->kind == MATERIAL_LEAF && (point->season != 0.0f || point->young > 0.0f)) {
        pattern_season(m, point, shade);
    }
    if (APPLY[m->pattern]) {
        APPLY[m->pattern](m, point, shade);
    }
    if (point->withered > 0.0f) { // whatever the green was
        pattern_wither(m, point, shade);
    }
    if (m->variation > 0.0f) {
        uint32_t hash = (uint32_t)(point->variation * 16777216.0f);
        float value = noise_unit(hash, 0), hue = noise_unit(hash, 1);
        shade->color = vary(shade->color, m->variation, value, hue);
        shade->transmittance = vary(shade->transmittance, m->variation, value, hue);
    }
}
