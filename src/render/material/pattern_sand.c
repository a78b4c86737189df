// Sand under shallow water: ripples that fork and fade, grains, darker troughs.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

// The profile of a ripple over its phase, with a steep lee and a gentle stoss side; *slope: its
// derivative.
static float ripple(float phase, float *slope)
{
    float s = sinf(phase), c = cosf(phase);
    float s2 = sinf(2.0f * phase + 0.6f), c2 = cosf(2.0f * phase + 0.6f);
    *slope = c + 0.5f * c2;
    return s + 0.25f * s2;
}

void pattern_sand(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float wavelength = m->pattern_scale > 0.0f ? m->pattern_scale : 0.11f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / wavelength), bend;
    float drift = noise_solid(vec3(0.16f * p.x, 0.0f, 0.11f * p.z), 41, &bend);
    float fork = noise_solid(vec3(0.42f * p.x, 0.0f, 0.3f * p.z), 42, NULL);
    float patch = noise_solid(vec3(0.07f * p.x, 0.0f, 0.07f * p.z), 43, NULL);
    float phase = 2.0f * PI_F * (0.94f * p.x + 0.34f * p.z + 1.5f * drift + 0.22f * fork), slope;
    float height = ripple(phase, &slope);
    float strength = smoothstepf(-0.55f, 0.35f, patch + 0.35f) * (0.75f + 0.25f * fork);
    strength *= pattern_detail(wavelength, point->footprint);
    Vec3 grain_slope;
    float fine = pattern_detail(0.06f * wavelength, point->footprint);
    float grain = noise_solid(vec3_scale(p, 22.0f), 44, &grain_slope) * fine;
    float speck = noise_solid(vec3_scale(p, 9.0f), 45, NULL);
    Vec3 color = vec3_lerp(shade->color, m->color2,
                           clampf(0.35f - 0.3f * height * strength + 0.35f * patch, 0.0f, 1.0f));
    color = vec3_scale(color, 1.0f + 0.12f * grain - 0.25f * smoothstepf(0.45f, 0.75f, speck));
    float per_metre = 2.0f * PI_F / wavelength * slope * strength * m->pattern_depth;
    Vec3 gradient =
        vec3(per_metre * (0.94f + 0.24f * bend.x), 0.0f, per_metre * (0.34f + 0.165f * bend.z));
    gradient = vec3_madd(gradient, 0.10f * fine, grain_slope);
    shade->normal = pattern_tilt(shade->normal, gradient);
    shade->color = color;
}
