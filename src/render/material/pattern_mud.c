// The bed of a pond: ooze that darkens with depth, heaps and furrows of mud, sunken litter, and a
// dark rim that dries upward.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

void pattern_mud(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.25f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale), slope;
    float footprint = point->footprint;
    float patches = noise_fractal(vec3_scale(p, 0.22f), 4, 61);
    float lumps = noise_solid(p, 62, &slope) * pattern_detail(scale, footprint);
    float fine = pattern_detail(0.15f * scale, footprint);
    Vec3 fine_slope;
    float grain = noise_solid(vec3_scale(p, 6.7f), 63, &fine_slope) * fine;
    // Depth over 1 m + itself: what sinks collects where the water is deep.
    float deep = smoothstepf(0.0f, 0.45f, point->site.x + 0.16f * patches + 0.05f * lumps);
    Vec3 color = vec3_lerp(shade->color, m->color2, deep);
    // Litter: flakes the size of leaves, some bleached, some black.
    CellPoint flakes = noise_cells(vec3_scale(p, 4.0f), 64);
    float flake = smoothstepf(0.10f, 0.2f, flakes.border) * fine;
    float tone = noise_unit(flakes.cell, 65);
    float lies = flake * smoothstepf(0.0f, 0.35f, patches + 0.6f * tone - 0.25f);
    color = vec3_lerp(color, vec3_scale(color, 0.55f + 1.1f * tone), 0.7f * lies);
    float wet = point->site.y;
    float dry = 1.0f + 0.7f * (1.0f - wet);
    shade->color = vec3_scale(color, dry * (1.0f + 0.22f * lumps + 0.18f * grain));
    slope = vec3_madd(slope, 0.3f * fine, fine_slope);
    float depth = m->pattern_depth * pattern_detail(scale, footprint);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, depth / scale));
}
