#include "render/material/pattern_crags.h"

#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

enum { SEED_WARP = 201, SEED_BLOCKS = 205 };

// A random vector of -1..1 per component, of a block.
static Vec3 block_vector(uint32_t cell)
{
    return vec3(2.0f * noise_unit(cell, 1) - 1.0f, 2.0f * noise_unit(cell, 2) - 1.0f,
                2.0f * noise_unit(cell, 3) - 1.0f);
}

// Bends the borders between blocks, which would be planes.
static Vec3 warped(Vec3 p, uint32_t seed)
{
    Vec3 bend = {noise_solid(p, seed, NULL), noise_solid(p, seed + 1, NULL),
                 noise_solid(p, seed + 2, NULL)};
    return vec3_madd(p, 0.3f, bend);
}

Crags pattern_crags(const SurfacePoint *point, float size)
{
    enum { SCALES = 4 };
    static const float tilt[SCALES] = {0.55f, 0.5f, 0.45f, 0.4f};
    Crags crags = {0};
    float weight = 0.0f;
    for (uint32_t k = 0; k < SCALES; k++, size *= 0.3f) {
        float seen = pattern_detail(0.7f * size, point->footprint);
        if (seen <= 0.0f) {
            break;
        }
        Vec3 p = vec3_scale(point->object_position, 1.0f / size);
        p = vec3(p.x, 0.55f * p.y, p.z);
        CellPoint block = noise_cells(warped(p, SEED_WARP + 3 * k), SEED_BLOCKS + 31 * k);
        crags.slope = vec3_madd(crags.slope, seen * tilt[k], block_vector(block.cell));
        crags.tone += seen * (2.0f * noise_unit(block.cell, 4) - 1.0f);
        float joint =
            seen * smoothstepf(0.09f, 0.0f, block.border) * noise_unit(block.cell ^ block.next, 5);
        crags.crevice = fmaxf(crags.crevice, joint);
        weight += 1.0f;
    }
    crags.tone = weight > 0.0f ? crags.tone / sqrtf(weight) : 0.0f;
    return crags;
}
