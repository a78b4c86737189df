// Pasture on hills: dry grass (color) on crests and sunny slopes, fresh grass and rushes (color2)
// where water gathers, terracettes along the contours of steep slopes, tussocks, bare scars.
// site.y is how wet the place is (HeightField.wetness).
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_shore.h"

#include <math.h>

// Steps of soil that creeps and cattle that walk along the slope: treads and bare risers.
typedef struct Steps {
    float riser; // 0..1: on the riser
    Vec3 slope;  // of the relief, per metre
} Steps;

static Steps terracettes(const SurfacePoint *point, float rise, float upright)
{
    PatternOctaves bend = pattern_octaves(point, 34.0f, 4, 0.5f, 1.0f, 311);
    float phase = 2.0f * PI_F * (point->object_position.y / rise + 0.7f * bend.value);
    float apart = rise / sqrtf(fmaxf(1.0f - upright * upright, 0.01f)); // m along the slope
    float seen = pattern_detail(apart, point->footprint) *
                 smoothstepf(0.935f, 0.87f, upright + 0.02f * bend.value);
    PatternOctaves ends = pattern_octaves(point, 30.0f, 3, 0.6f, 1.0f, 317);
    seen *= smoothstepf(-0.35f, 0.25f, ends.value);
    float wave = sinf(phase);
    return (Steps){.riser = seen * smoothstepf(0.2f, 0.9f, wave),
                   .slope = vec3(0.0f, 0.4f * seen * cosf(phase), 0.0f)};
}

void pattern_hills(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 1.0f;
    float upright = fabsf(surface_smooth_normal(point).y);
    PatternOctaves broad = pattern_octaves(point, 90.0f * scale, 4, 0.6f, 1.0f, 301);
    PatternOctaves sward = pattern_octaves(point, 6.0f * scale, 5, 0.7f, 1.0f, 303);
    PatternOctaves tufts = pattern_octaves(point, 0.5f * scale, 4, 0.7f, 0.8f, 307);
    Steps steps = terracettes(point, 0.6f * scale, upright);
    float wet = point->site.y + 0.22f * broad.value + 0.10f * sward.value;
    float green = smoothstepf(0.25f, 0.75f, wet);
    Vec3 grass = vec3_lerp(shade->color, m->color2, green);
    // Ripe seed heads are pale, last year's thatch is brown.
    Vec3 thatch = vec3_mul(grass, vec3(0.62f, 0.55f, 0.50f));
    float old = smoothstepf(-0.1f, 0.9f, sward.value + 0.45f * tufts.value);
    grass = vec3_lerp(grass, thatch, 0.4f * old);
    grass = vec3_scale(grass, 1.0f + 0.16f * clampf(broad.value, -1.0f, 1.0f) +
                                  0.22f * clampf(tufts.value, -1.2f, 1.2f));
    // Rushes and bramble stand dark along the wettest lines.
    float rushes = smoothstepf(0.80f, 1.0f, wet + 0.15f * tufts.value);
    grass = vec3_lerp(grass, vec3_scale(m->color2, 0.45f), 0.7f * rushes);
    // Bare ground on risers and in small slides.
    float scar = smoothstepf(0.90f, 0.80f, upright + 0.05f * sward.value) *
                 smoothstepf(0.35f, 0.6f, sward.value - 0.2f * broad.value);
    Vec3 soil = {0.155f, 0.115f, 0.075f};
    float bare = fmaxf(0.75f * scar, 0.35f * steps.riser);
    float depth = m->pattern_depth;
    Vec3 slope = vec3_scale(sward.slope, 0.15f * depth);
    slope = vec3_madd(slope, 0.06f * depth * (1.0f - bare), tufts.slope);
    slope = vec3_madd(slope, depth, steps.slope);
    Ground g = {vec3_lerp(grass, soil, bare), slope};
    g = pattern_shore(point, vec3(0.25f, 0.23f, 0.20f), 1.0f, g);
    shade->color = g.color;
    shade->normal = pattern_tilt(shade->normal, g.slope);
}
