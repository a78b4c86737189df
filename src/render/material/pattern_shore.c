#include "render/material/pattern_shore.h"

#include "base/mesh.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>

enum { SEED_STONES = 601, SEED_RAGGED = 611, SEED_PATCHES = 613, SEED_SILT = 617 };

// Each has a tone of its own; gaps between them are dark.
Ground pattern_stones(const SurfacePoint *point, Vec3 rock)
{
    enum { SIZES = 4 };
    static const float size[SIZES] = {0.9f, 0.32f, 0.12f, 0.045f}; // m
    Ground g = {.color = rock};
    PatternOctaves patches = pattern_octaves(point, 3.0f, 4, 0.6f, 1.0f, SEED_PATCHES);
    Vec3 p = point->object_position;
    for (uint32_t i = 0; i < SIZES; i++) {
        float seen = pattern_detail(0.7f * size[i], point->footprint);
        if (seen <= 0.0f) {
            break;
        }
        Vec3 q = vec3_scale(p, 1.0f / size[i]);
        q.y *= 1.5f; // they lie flat
        CellPoint cell = noise_cells(q, SEED_STONES + i);
        // Large ones lie apart, in what is smaller.
        float among = noise_unit(cell.cell, 31) + 0.25f * patches.value;
        float lies = seen * (i + 1 < SIZES ? smoothstepf(0.62f, 0.66f, among) : 1.0f);
        float kind = noise_unit(cell.cell, 33);
        float tone = 0.55f + 0.75f * noise_unit(cell.cell, 35);
        Vec3 tint = kind < 0.2f    ? vec3(1.08f, 0.98f, 0.86f)
                    : kind < 0.35f ? vec3(0.80f, 0.84f, 0.86f)
                                   : vec3(1.0f, 1.0f, 1.0f);
        float gap = smoothstepf(0.10f, 0.0f, cell.border);
        Vec3 color = vec3_scale(vec3_mul(rock, tint), tone * (1.0f - 0.6f * gap));
        float round = 1.0f - smoothstepf(0.0f, 0.35f, cell.border);
        Ground stone = {color, vec3_scale(cell.normal, 1.3f * round)};
        g = ground_blend(g, &stone, lies);
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
