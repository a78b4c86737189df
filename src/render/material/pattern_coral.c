// Living coral: corallites (a raised ring about a dark cup, one beside the other), the winding
// ridges of brain corals, and the age of the tissue, pale where it is young.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

// Blends color and color2 by the nearness of a growing tip or margin.
static Vec3 tissue(const Material *m, Vec3 own, float birth)
{
    return vec3_lerp(own, m->color2, smoothstepf(0.15f, 1.0f, birth));
}

void pattern_youth(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    Vec3 p = vec3_scale(point->position, 22.0f);
    float blotch = 1.0f + 0.16f * noise_solid(p, 31, NULL);
    shade->color = vec3_scale(tissue(m, shade->color, point->birth), blotch);
}

// Height 0..1 and its slope as functions of the distance (in cells) from the border between two
// corallites: a groove, a rim, a cup.
static float ring(float border, float *slope)
{
    const float rim = 0.15f, cup = 0.34f;
    if (border < rim) {
        float t = border / rim;
        *slope = 6.0f * t * (1.0f - t) / rim;
        return t * t * (3.0f - 2.0f * t);
    }
    float t = clampf((border - rim) / (cup - rim), 0.0f, 1.0f);
    *slope = -0.85f * 6.0f * t * (1.0f - t) / (cup - rim);
    return 1.0f - 0.85f * t * t * (3.0f - 2.0f * t);
}

void pattern_corallite(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.0025f;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale), warp;
    noise_solid(vec3_scale(p, 0.45f), 33, &warp);
    float large = noise_solid(vec3_scale(point->object_position, 0.045f / scale), 34, NULL);
    float detail = pattern_detail(0.8f * scale, point->footprint);
    Vec3 color = tissue(m, shade->color, point->birth);
    color = vec3_scale(color, 1.0f + 0.22f * large);
    if (detail > 0.0f) {
        CellPoint cell = noise_cells_on(vec3_madd(p, 0.12f, warp), shade->normal, 35);
        float slope, height = ring(cell.border, &slope);
        float cup = smoothstepf(0.2f, 0.36f, cell.border);
        float value =
            0.62f + 0.5f * height - 0.12f * cup + 0.16f * (noise_unit(cell.cell, 3) - 0.5f);
        color = vec3_lerp(color, vec3_scale(color, value), detail);
        Vec3 gradient = vec3_scale(cell.normal, slope / scale);
        shade->normal =
            pattern_tilt(shade->normal, vec3_scale(gradient, detail * m->pattern_depth));
    }
    shade->color = color;
}

// Height 0..1 of a brain coral by the cosine of the phase (1 on a ridge), and its slope: broad
// ridges with a groove along their crests, narrow valleys.
static float ridge(float cosine, float *slope)
{
    const float foot = -0.75f, head = 0.35f, groove = 0.9f;
    float t = clampf((cosine - foot) / (head - foot), 0.0f, 1.0f);
    float deep = fmaxf(0.0f, cosine - groove) / (1.0f - groove);
    *slope = 6.0f * t * (1.0f - t) / (head - foot) - 0.5f * deep / (1.0f - groove);
    return t * t * (3.0f - 2.0f * t) - 0.25f * deep * deep;
}

void pattern_brain(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const float wavelength = 0.4f; // of a unit cell of the noise
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale : 0.012f;
    Vec3 p = vec3_scale(point->object_position, wavelength / scale);
    float large = noise_solid(vec3_scale(point->object_position, 0.12f / scale), 36, NULL);
    float detail = pattern_detail(0.5f * scale, point->footprint);
    Vec3 middle = vec3_lerp(m->color2, shade->color, 0.6f), color = middle;
    if (detail > 0.0f) {
        Stripes stripes = noise_stripes_on(p, shade->normal, wavelength, 37);
        float slope, height = ridge(stripes.cosine, &slope);
        float sure = detail * smoothstepf(0.0f, 0.2f, stripes.strength);
        Vec3 own = vec3_lerp(m->color2, shade->color, smoothstepf(0.1f, 0.75f, height));
        color = vec3_lerp(middle, vec3_scale(own, 0.75f + 0.3f * height), sure);
        float steep = -stripes.sine * slope * wavelength / scale;
        Vec3 gradient = vec3_scale(stripes.gradient, steep * sure * m->pattern_depth);
        shade->normal = pattern_tilt(shade->normal, gradient);
    }
    shade->color = vec3_scale(color, 1.0f + 0.2f * large);
}
