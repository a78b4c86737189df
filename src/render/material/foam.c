#include "render/material/foam.h"

#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

// What holes of foam are before the pixel is wide enough to show none of them.
typedef struct FoamScale {
    float size; // m: of the holes
    uint32_t seed;
} FoamScale;

// Share of the pixel that strands between holes cover, which reach `half` of a hole's size from the
// middle of a strand; 0.5 fills the holes.
static float strands(const FoamScale *scale, Vec2 at, float half, float width)
{
    float seen = pattern_detail(scale->size, width), mean = clampf(1.8f * half, 0.0f, 1.0f);
    if (seen <= 0.0f) {
        return mean;
    }
    Vec3 p = {at.x / scale->size, 0.5f, at.y / scale->size}, bend = vec3_scale(p, 1.9f);
    p.x += 0.3f * noise_solid(bend, scale->seed + 1, NULL);
    p.z += 0.3f * noise_solid(bend, scale->seed + 2, NULL);
    float border = noise_cells(p, scale->seed).border;
    return lerpf(mean, 1.0f - smoothstepf(half - 0.04f, half + 0.1f, border), seen);
}

// Share of the pixel that lies within threads of foam, about `cover` of all: where ridges of noise
// of several sizes cross a threshold, so that threads branch, widen and end.
static float threads(float cover, Vec2 at, float width)
{
    const float least = 0.3f, most = 0.95f; // thresholds at which ridges are all white, and none
    float size = 2.6f, weight = 1.0f, sum = 0.0f, all = 0.0f, resolved = 0.0f;
    Vec3 p = {at.x, 0.5f, at.y}, bend = vec3_scale(p, 0.5f);
    p.x += 0.8f * noise_fractal(bend, 3, 841);
    p.z += 0.8f * noise_fractal(bend, 3, 845);
    for (uint32_t i = 0; i < 5; i++, size *= 0.47f, weight *= 0.66f) {
        const float mean = 0.6f;
        float seen = pattern_detail(size, width);
        float ridge = mean;
        if (seen > 0.0f) {
            float n = noise_solid(vec3_scale(p, 1.0f / size), 851 + i, NULL);
            ridge = lerpf(mean, clampf(1.0f - fabsf(n) / 0.6f, 0.0f, 1.0f), seen);
        }
        sum += weight * ridge;
        all += weight;
        resolved += weight * seen;
    }
    float threshold = lerpf(most, least, cover), unresolved = 1.0f - resolved / all;
    float soft = 0.08f + 0.4f * unresolved;
    float share = smoothstepf(threshold - soft, threshold + soft, sum / all);
    return lerpf(share, cover, unresolved);
}

float foam_share(float cover, Vec2 at, float width)
{
    static const FoamScale fine = {0.3f, 821};
    if (cover <= 0.0f) {
        return 0.0f;
    }
    float ragged = noise_fractal(vec3(at.x / 5.0f, 0.3f, at.y / 5.0f), 6, 831);
    float dense = clampf(cover + 1.1f * (cover + 0.1f) * ragged - 0.06f, 0.0f, 1.0f);
    float lace = threads(dense, at, width);
    float film = strands(&fine, at, 0.55f * dense, width);
    return smoothstepf(0.0f, 0.25f, dense) *
           fmaxf(lace * (0.35f + 0.65f * film), dense * dense * film);
}
