// A meadow from above: clumps of grass in several greens, yellowed spots, bare earth between.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

void pattern_ground(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 2.5f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale), slope;
    float footprint = point->footprint;
    float patches = noise_fractal(vec3(p.x, 0.3f * p.y, p.z), 4, 21);
    float dry = noise_fractal(vec3(2.3f * p.x + 7.0f, 0.5f * p.y, 2.3f * p.z), 3, 22);
    float clump_size = 0.06f * scale, tuft_size = 0.011f * scale;
    float clumps = noise_solid(vec3_scale(point->object_position, 1.0f / clump_size), 23, &slope) *
                   pattern_detail(clump_size, footprint);
    float tufts = 0.0f;
    float tuft_detail = pattern_detail(tuft_size, footprint);
    if (tuft_detail > 0.0f) {
        Vec3 tuft_slope, q = vec3_scale(point->object_position, 1.0f / tuft_size);
        tufts = noise_solid(q, 24, &tuft_slope) * tuft_detail;
        slope = vec3_madd(slope, 0.35f * tuft_detail * clump_size / tuft_size, tuft_slope);
    }
    Vec3 green = shade->color;
    Vec3 lush = vec3(0.66f * green.x, 0.8f * green.y, 0.85f * green.z);
    Vec3 straw = vec3(1.5f * green.x + 0.02f, 1.1f * green.y + 0.01f, 1.25f * green.z + 0.01f);
    Vec3 color = vec3_lerp(lush, green, smoothstepf(-0.35f, 0.3f, patches));
    color = vec3_lerp(color, straw, 0.65f * smoothstepf(-0.05f, 0.7f, dry + 0.35f * clumps));
    float bare = smoothstepf(0.28f, 0.6f, patches - 0.35f * dry + 0.25f * clumps);
    color = vec3_lerp(color, m->color2, bare);
    shade->color = vec3_scale(color, 1.0f + 0.28f * clumps + 0.35f * tufts);
    float depth = m->pattern_depth * pattern_detail(clump_size, footprint);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, depth / clump_size));
}
