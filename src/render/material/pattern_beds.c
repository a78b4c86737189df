#include "render/material/pattern_beds.h"

#include "render/material/pattern_noise.h"

#include <stddef.h>

enum { SEED_WOBBLE = 301 };

float beds_level(const SurfacePoint *point)
{
    Vec3 p = point->object_position;
    float wobble = 1.1f * noise_solid(vec3_scale(p, 1.0f / 60.0f), SEED_WOBBLE, NULL) +
                   0.3f * noise_solid(vec3_scale(p, 1.0f / 9.0f), SEED_WOBBLE + 1, NULL);
    return p.y - strata_base(point->strata, p.x, p.z) + wobble;
}

Vec3 beds_color(const Strata *strata, float level)
{
    return strata->bed[strata_bed(strata, level)].color;
}

Vec3 beds_mean_color(const Strata *strata, float level, float footprint)
{
    float third = 0.33f * footprint;
    Vec3 sum = vec3_add(beds_color(strata, level - third), beds_color(strata, level + third));
    return vec3_scale(vec3_add(sum, beds_color(strata, level)), 1.0f / 3.0f);
}

Vec3 beds_tinted(const SurfacePoint *point, float level, Vec3 color)
{
    const Strata *strata = point->strata;
    Vec3 bed = beds_mean_color(strata, level, point->footprint), mean = strata->mean_color;
    const float least = 1e-3f;
    return vec3(color.x * bed.x / fmaxf(mean.x, least), color.y * bed.y / fmaxf(mean.y, least),
                color.z * bed.z / fmaxf(mean.z, least));
}
