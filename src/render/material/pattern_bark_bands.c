// Glossy bark with corky bands across the stem, as of cherries.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// Dashes across the stem where a noise of these wavelengths (m) exceeds `above`; 0..1.
// *rise: the integral of that over the noise.
static float dashes(const StemPlace *place, float around, float along, float above, uint32_t seed,
                    Vec3 *gradient, float *rise)
{
    float n = noise_solid(stem_lookup(place, around, along), seed, gradient);
    *rise = stem_smooth_ramp(0.22f, n - above);
    return smoothstepf(above, above + 0.22f, n);
}

BarkLook bark_bands(const Material *m, const StemPlace *place, float scale, float footprint)
{
    BarkLook look = {0};
    Vec3 g, h;
    float tone = noise_solid(stem_lookup(place, 0.5f * scale, 0.07f * scale), 31, NULL);
    float streak = noise_solid(stem_lookup(place, 0.22f * scale, 0.012f * scale), 32, &h);
    look.color = vec3_scale(m->color, 1.0f + 0.28f * tone + 0.14f * streak);
    stem_add_relief(&look, place, 0.07f * streak, 0.07f, 0.22f * scale, 0.012f * scale, h);
    float seen = pattern_detail(0.02f * scale, footprint);
    float cork = 0.35f + 0.65f * smoothstepf(0.01f, 0.05f, place->radius);
    if (seen > 0.0f) {
        float around = 0.11f * scale * cork, along = 0.016f * scale * cork;
        float rise, band = dashes(place, around, along, 0.30f, 33, &g, &rise);
        stem_add_relief(&look, place, 0.8f * rise * seen, 0.8f * band * seen, around, along, g);
        float split = noise_solid(stem_lookup(place, 0.006f * scale, 0.02f * scale), 34, NULL);
        Vec3 cork_color = vec3_scale(m->color2, 0.9f + 0.35f * split);
        look.color = vec3_lerp(look.color, cork_color, band * seen);
    } else {
        look.color = vec3_lerp(look.color, m->color2, 0.15f);
    }
    // The foot of an old trunk is rough and dull.
    float foot = smoothstepf(0.12f, 0.3f, place->radius) *
                 expf(-fmaxf(place->height, 0.0f) / (3.0f * place->radius + 0.05f));
    float rough = noise_fractal(stem_lookup(place, 0.05f * scale, 0.11f * scale), 3, 35);
    Vec3 dull = vec3_scale(vec3(0.085f, 0.072f, 0.062f), 1.0f + 0.6f * rough);
    look.color = vec3_lerp(look.color, dull, foot);
    return look;
}
