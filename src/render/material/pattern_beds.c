#include "render/material/pattern_beds.h"

#include "render/material/pattern.h"
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

Vec3 beds_mean_between(const Strata *strata, float low, float high)
{
    int bed = strata_bed(strata, high), last = strata->bed_count - 1;
    if (!(high > low)) {
        return strata->bed[bed].color;
    }
    Vec3 sum = {0};
    for (float top = high; top > low; bed++) {
        float floor = bed == last ? low : fmaxf(strata->floor[bed], low);
        sum = vec3_madd(sum, (top - floor) / (high - low), strata->bed[bed].color);
        top = floor;
    }
    return sum;
}

Vec3 beds_mean_color(const Strata *strata, float level, float footprint)
{
    return beds_mean_between(strata, level - 0.5f * footprint, level + 0.5f * footprint);
}

float beds_lamina_tone(const Strata *strata, float level, float footprint, float share)
{
    int number = strata_bed(strata, level);
    float lamina = share * strata->bed[number].lamina;
    if (lamina <= 0.0f) {
        return 0.5f;
    }
    uint32_t seed = 7919u * (uint32_t)number;
    return 0.5f * pattern_lamina(level, lamina, footprint, 0.75f, seed + 11) +
           0.3f * pattern_lamina(level, 0.27f * lamina, footprint, 0.75f, seed + 13) +
           0.2f * pattern_lamina(level, 0.07f * lamina, footprint, 0.75f, seed + 17);
}

Vec3 beds_tinted(const SurfacePoint *point, float level, Vec3 color)
{
    const Strata *strata = point->strata;
    Vec3 bed = beds_mean_color(strata, level, point->footprint), mean = strata->mean_color;
    const float least = 1e-3f;
    return vec3(color.x * bed.x / fmaxf(mean.x, least), color.y * bed.y / fmaxf(mean.y, least),
                color.z * bed.z / fmaxf(mean.z, least));
}
