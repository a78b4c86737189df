#include "render/material/overgrowth.h"

#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

Overgrowth moss_at(float amount, const SurfacePoint *point, float damp, float low, float thickest)
{
    Vec3 p = point->object_position;
    float patch = noise_fractal(vec3_scale(p, 1.0f / 0.16f), 4, 101);
    float grown = 1.7f * amount * damp + 0.45f * patch + 0.30f * low - 0.62f;
    float share = smoothstepf(0.0f, 0.22f, grown);
    if (share <= 0.0f) {
        return (Overgrowth){0};
    }
    float seen = pattern_detail(0.012f, point->footprint);
    float puff = noise_solid(vec3_scale(p, 1.0f / 0.022f), 105, NULL);
    float tuft = seen * noise_fractal(vec3_scale(p, 1.0f / 0.0055f), 2, 106);
    float height =
        share * thickest * (0.35f + 0.35f * puff + 0.30f * tuft + 0.5f * clampf(grown, 0.0f, 1.0f));
    Vec3 dark = vec3(0.030f, 0.047f, 0.010f), tip = vec3(0.120f, 0.150f, 0.030f);
    Vec3 green = vec3_lerp(dark, tip, clampf(0.42f + 0.35f * puff + 0.5f * tuft, 0.0f, 1.0f));
    return (Overgrowth){share, height, green};
}

Overgrowth lichen_at(float amount, const SurfacePoint *point)
{
    const float spacing = 0.075f; // m
    Vec3 p = point->object_position;
    float wave = noise_fractal(vec3_scale(p, 1.0f / 0.016f), 3, 111);
    float where = 0.5f + 0.9f * noise_solid(vec3_scale(p, 1.0f / 0.35f), 114, NULL);
    CellPoint cell = noise_cells(vec3_scale(p, 1.0f / spacing), 115);
    float seen = pattern_detail(0.5f * spacing, point->footprint);
    float size = lerpf(0.12f, 0.46f, noise_unit(cell.cell, 2));
    float t = vec3_length(cell.point) / size + 0.6f * wave;
    bool grows = noise_unit(cell.cell, 1) < amount * where;
    float share = grows ? seen * (1.0f - smoothstepf(0.85f, 1.0f, t)) : 0.0f;
    float rim = smoothstepf(0.5f, 0.9f, t);
    bool yellow = noise_unit(cell.cell, 3) > 0.88f;
    Vec3 color = yellow ? vec3(0.40f, 0.29f, 0.05f) : vec3(0.30f, 0.33f, 0.26f);
    color = vec3_scale(color, 0.85f + 0.18f * rim + 0.3f * wave);
    return (Overgrowth){0.8f * share, 0.0012f * share, color};
}
