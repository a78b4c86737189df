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
    p.x += 0.45f * noise_fractal(bend, 3, scale->seed + 1);
    p.z += 0.45f * noise_fractal(bend, 3, scale->seed + 5);
    float border = noise_cells(p, scale->seed).border;
    // Strands are torn: here thick, there broken.
    half *= 1.0f + 0.7f * noise_solid(vec3_scale(p, 0.8f), scale->seed + 9, NULL);
    return lerpf(mean, 1.0f - smoothstepf(half - 0.04f, half + 0.1f, border), seen);
}

float foam_share(float cover, Vec2 at, float width)
{
    static const FoamScale coarse = {1.5f, 811}, fine = {0.35f, 821};
    if (cover <= 0.0f) {
        return 0.0f;
    }
    float ragged = noise_fractal(vec3(at.x / 5.0f, 0.3f, at.y / 5.0f), 6, 831);
    float dense = clampf(cover + 1.1f * (cover + 0.1f) * ragged - 0.06f, 0.0f, 1.0f);
    float lace = strands(&coarse, at, 0.5f * dense - 0.04f, width);
    float film = strands(&fine, at, 0.55f * dense, width);
    return smoothstepf(0.0f, 0.25f, dense) *
           fmaxf(lace * (0.35f + 0.65f * film), dense * dense * film);
}
