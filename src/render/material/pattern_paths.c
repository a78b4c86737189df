#include "render/material/pattern_paths.h"

#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

float path_share(float away, float width, float footprint)
{
    float half = 0.5f * width, pixel = 0.5f * fmaxf(footprint, 0.01f * width);
    float from = fmaxf(-half, away - pixel), to = fminf(half, away + pixel);
    return clampf((to - from) / (2.0f * pixel), 0.0f, 1.0f);
}

// 0..1: how far the path of this number is trodden here; paths begin and end along their way.
static float trodden(const SurfacePoint *point, uint32_t path, float length, float least)
{
    Vec3 p = vec3_scale(point->object_position, 1.0f / length);
    return smoothstepf(least, least + 0.45f, noise_solid(vec3(p.x, 0.5f, p.z), path, NULL));
}

#define RISER 0.16f // its width, of the distance between treads

Paths pattern_terracettes(const SurfacePoint *point, float rise, uint32_t seed)
{
    float upright = fabsf(surface_smooth_normal(point).y);
    float steep = sqrtf(fmaxf(1.0f - upright * upright, 0.01f));
    float apart = rise / steep; // m along the slope
    if (upright > 0.985f) {
        return (Paths){0};
    }
    PatternOctaves bend = pattern_octaves(point, 55.0f * rise, 4, 0.5f, 1.0f, seed);
    float most = smoothstepf(0.965f, 0.925f, upright + 0.02f * bend.value);
    if (most <= 0.0f) {
        return (Paths){0};
    }
    PatternOctaves herd = pattern_octaves(point, 75.0f * rise, 4, 0.6f, 1.0f, seed + 1);
    most *= smoothstepf(-0.45f, 0.25f, herd.value);
    // Treads draw together and apart, and meet.
    PatternOctaves drift = pattern_octaves(point, 16.0f * rise, 2, 0.5f, 1.0f, seed + 2);
    float level = point->object_position.y / rise + 1.1f * bend.value + 1.3f * drift.value;
    float whole = floorf(level);
    uint32_t path = seed + (uint32_t)(int32_t)whole * 2654435761u;
    most *= trodden(point, path, 14.0f * rise, -0.4f);
    float tread = 0.15f + 0.30f * noise_unit(path, 1), middle = 0.25f + 0.4f * noise_unit(path, 2);
    float f = level - whole - middle, pixel = point->footprint;
    float seen = pattern_detail(apart, pixel); // beyond, pixels hold several
    Paths p = {.share = most * lerpf(0.30f, path_share(apart * f, apart * tread, pixel), seen)};
    // the riser above the tread: a bare edge under overhanging grass
    float riser = f - 0.5f * (tread + RISER);
    p.edge = most * lerpf(RISER, path_share(apart * riser, apart * RISER, pixel), seen);
    p.slope.y = seen * (1.3f * p.edge - 0.55f * p.share);
    return p;
}

Paths pattern_tracks(const SurfacePoint *point, float width, uint32_t seed)
{
    const float apart = 34.0f * width; // m of height from track to track, were the land smooth
    Vec3 n = surface_smooth_normal(point), gradient;
    Vec3 p = vec3_scale(point->object_position, 1.0f / (260.0f * width));
    float bend = noise_solid(vec3(p.x, 0.5f, p.z), seed, &gradient);
    PatternOctaves sway = pattern_octaves(point, 24.0f * width, 2, 0.45f, 1.0f, seed + 1);
    float level = point->object_position.y / apart + 2.6f * bend + 0.05f * sway.value;
    // per metre along the slope: of altitude and of the bend
    float uphill = -1.0f / fmaxf(fabsf(n.y), 0.3f) / apart;
    Vec3 rate = {uphill * n.x, 0.0f, uphill * n.z};
    rate = vec3_madd(rate, 2.6f / (260.0f * width), vec3(gradient.x, 0.0f, gradient.z));
    float whole = floorf(level);
    uint32_t path = seed + (uint32_t)(int32_t)whole * 2654435761u;
    float away = (level - whole - 0.5f) / fmaxf(vec3_length(rate), 0.1f / apart);
    return (Paths){.share = trodden(point, path, 160.0f * width, -0.25f) *
                            path_share(away, width, point->footprint)};
}
