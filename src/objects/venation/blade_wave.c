#include "objects/venation/blade_wave.h"

#include "base/exact_math.h"
#include "grow/venation/secondaries.h"
#include "render/material/pattern_noise.h"

#define FURROWED 0.4f      // share of the waves that follow the secondary veins
#define COMMON_VEINS 9     // on each side, where secondaries grow as other veins do
#define VEINS_TO_WAVE 3.2f // secondary veins to a wave of the margin

float blade_wave(const VenationParams *params, Vec3 p)
{
    float half = leaf_half_width(&params->outline, p.y);
    if (params->wave == 0.0f || !(half > 0.0f)) {
        return 0.0f;
    }
    float side = p.x < 0.0f ? -1.0f : 1.0f, u = fminf(fabsf(p.x) / half, 1.2f), sine, cosine;
    int count = params->secondaries > 0 ? params->secondaries : COMMON_VEINS;
    float number = secondary_number(&params->outline, count, p);
    exact_sincos(2.0f * PI_F * number, &sine, &cosine);
    // furrows are deepest half-way to the margin, where the veins have turned into arches
    float furrow = -cosine * u * u * fmaxf(1.6f - u, 0.0f);
    Vec3 at = vec3(number / VEINS_TO_WAVE, 7.0f * side + 0.6f * u,
                   (float)(params->outline.key % 1024) + 0.4f); // between the zeros of the noise
    float margin = 1.6f * noise_fractal(at, 2, 67) * u * u;
    // both vanish at the ends, where the blade is narrow
    float room = smoothstepf(0.0f, 0.5f, 2.0f * half / params->outline.width);
    return params->wave * room * (FURROWED * furrow + (1.0f - FURROWED) * margin);
}
