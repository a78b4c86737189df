#include "render/material/pattern_shore.h"

#include "base/mesh.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>

enum { SEED_STONES = 601, SEED_RAGGED = 611, SEED_PATCHES = 613, SEED_SILT = 617 };

// Each has a tone of its own; gaps between them are dark.
// Stones of one size (m), which water has rounded. stands: the share of them that lie there, 0..1.
// covered: where one lies, 0..1.
static Ground stones_of(Vec3 p, float size, uint32_t seed, Vec3 rock, float stands, float *covered)
{
    Vec3 q = vec3(p.x / size, 0.5f, 1.3f * p.z / size);
    CellPoint cell = noise_cells_on(q, vec3(0, 1, 0), seed);
    float away = sqrtf(cell.point.x * cell.point.x + cell.point.z * cell.point.z);
    float radius = 0.26f + 0.3f * noise_unit(cell.cell, 37);
    float inside = fminf(cell.border, radius - away) - 0.03f;
    float lies = noise_unit(cell.cell, 31) < stands;
    *covered = lies * smoothstepf(0.0f, 0.05f, inside);
    float kind = noise_unit(cell.cell, 33), tone = 0.6f + 0.62f * noise_unit(cell.cell, 35);
    Vec3 tint = kind < 0.2f    ? vec3(1.08f, 0.98f, 0.86f)
                : kind < 0.35f ? vec3(0.80f, 0.84f, 0.86f)
                               : vec3(1.0f, 1.0f, 1.0f);
    float rim = 1.0f - smoothstepf(0.0f, 0.12f, inside);
    float round = 1.0f - smoothstepf(0.0f, 0.3f, inside);
    Vec3 rises = away > 1e-4f ? vec3_scale(vec3(cell.point.x, 0, cell.point.z), 1.0f / away)
                              : vec3_splat(0.0f);
    return (Ground){vec3_scale(vec3_mul(rock, tint), tone * (1.0f - 0.3f * rim)),
                    vec3_scale(rises, 1.2f * round)};
}

Ground pattern_stones(const SurfacePoint *point, Vec3 rock)
{
    enum { SIZES = 5 };
    static const float size[SIZES] = {0.055f, 0.12f, 0.24f, 0.45f, 0.9f}; // m, the smallest beneath
    static const float share[SIZES] = {1.0f, 0.65f, 0.4f, 0.22f, 0.08f};
    PatternOctaves patches = pattern_octaves(point, 3.0f, 4, 0.6f, 1.0f, SEED_PATCHES);
    float grit = pattern_octaves(point, 0.5f, 6, 0.8f, 1.0f, SEED_PATCHES + 5).value;
    Ground g = {.color = vec3_scale(rock, 0.82f + 0.12f * clampf(grit, -1.5f, 1.5f))};
    for (uint32_t i = 0; i < SIZES; i++) {
        float seen = pattern_detail(0.7f * size[i], point->footprint), covered;
        if (seen <= 0.0f) {
            continue;
        }
        float stands = share[i] + 0.5f * (1.0f - share[i]) * clampf(patches.value, -0.8f, 0.8f);
        Ground stone =
            stones_of(point->object_position, size[i], SEED_STONES + i, rock, stands, &covered);
        g = ground_blend(g, &stone, seen * covered);
    }
    return g;
}

// What settles in still water below the waves' reach.
static Ground silt(const SurfacePoint *point, Vec3 rock)
{
    PatternOctaves drift = pattern_octaves(point, 2.5f, 5, 0.6f, 1.0f, SEED_SILT);
    Vec3 color =
        vec3_lerp(vec3_mul(rock, vec3(0.95f, 0.90f, 0.72f)), vec3(0.16f, 0.15f, 0.10f), 0.4f);
    return (Ground){vec3_scale(color, 1.0f + 0.22f * clampf(drift.value, -1.3f, 1.3f)),
                    vec3_scale(drift.slope, 0.02f)};
}

Ground pattern_shore(const SurfacePoint *point, Vec3 rock, float depth, Ground ground)
{
    if (point->shore <= 0.0f) {
        return ground;
    }
    float above = MESH_SHORE - point->shore; // m
    float upright = fabsf(surface_smooth_normal(point).y);
    float ragged = pattern_octaves(point, 5.0f, 6, 0.62f, 1.0f, SEED_RAGGED).value;
    float washed = smoothstepf(1.5f, 0.45f, above + 0.45f * ragged) *
                   smoothstepf(0.70f, 0.80f, upright + 0.06f * ragged);
    if (washed > 0.0f) {
        Ground beach = pattern_stones(point, rock);
        float still = smoothstepf(-1.2f, -3.5f, above + 0.6f * ragged);
        if (still > 0.0f) {
            Ground bed = silt(point, rock);
            beach = ground_blend(beach, &bed, 0.8f * still);
        }
        beach.slope = vec3_scale(beach.slope, depth > 0.0f ? 1.0f / depth : 1.0f);
        ground = ground_blend(ground, &beach, washed);
    }
    // Waves wet a strip above the level; what is wet is darker, for light leaves it less easily.
    float wet = smoothstepf(0.20f, 0.06f, above + 0.06f * ragged);
    ground.color = vec3_scale(ground.color, 1.0f - 0.45f * wet);
    return ground;
}
