// Young ice under a clear, cold night: dark and glossy, dulled in patches by a haze of frost too
// fine to see, and dusted with grains of rime, most where the haze is thickest. Each white grain
// has no gloss of its own. A pixel too large for a size of grains shows their mean.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

#define DULLER 0.38f       // roughness that the thickest haze adds
#define GRAIN_SHARE 0.175f // of the surface, if there is a grain in each cell

enum { SEED_HAZE = 301, SEED_BUMPS = 321, SEED_GRAINS = 341 };

// The white share 0..1 of grains about `size` m apart, of which the share `density` exists.
static float grains(const SurfacePoint *point, float size, float density, uint32_t seed)
{
    float seen = pattern_detail(0.8f * size, point->footprint), mean = density * GRAIN_SHARE;
    if (seen <= 0.0f) {
        return mean;
    }
    Vec3 p = vec3_scale(point->object_position, 1.0f / size), n = surface_smooth_normal(point);
    CellPoint cell = noise_cells_on(p, n, seed);
    float u = noise_unit(cell.cell, seed + 1); // most are small
    float radius = lerpf(0.1f, 0.44f, u * u);
    radius *= 1.0f + 0.5f * noise_solid(vec3_scale(p, 3.1f), seed + 2, NULL); // ragged
    Vec3 away = vec3_madd(cell.point, -vec3_dot(cell.point, n), n);
    float inside = 1.0f - smoothstepf(0.75f, 1.1f, vec3_length(away) / radius);
    float there = noise_unit(cell.cell, seed + 3) < density ? 0.75f * inside : 0.0f;
    return lerpf(mean, there, seen);
}

void pattern_ice(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.06f;
    PatternOctaves patches = pattern_octaves(point, scale, 4, 0.55f, 1.0f, SEED_HAZE);
    float haze = smoothstepf(-0.25f, 0.7f, patches.value);
    float thick = smoothstepf(0.25f, 0.9f, patches.value);
    float density = 0.03f + 0.13f * haze + 0.4f * thick;
    float clear = 1.0f - 0.02f * haze - 0.1f * thick;
    clear *= 1.0f - grains(point, 0.034f * scale, 0.4f * density, SEED_GRAINS);
    clear *= 1.0f - grains(point, 0.012f * scale, density, SEED_GRAINS + 10);
    shade->roughness = fminf(1.0f, m->roughness + DULLER * haze);
    shade->foam = 1.0f - clear;
    shade->color = vec3_lerp(shade->color, m->color2, shade->foam);
    PatternOctaves bumps = pattern_octaves(point, 0.5f * scale, 5, 0.5f, 1.0f, SEED_BUMPS);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(bumps.slope, 0.5f * m->pattern_depth));
}
