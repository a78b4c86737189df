// Bark of spruces: thin scales in layers. Each lies at a level of its own, its lower end stands
// off, and its edge is a step; where one has come off, the bark beneath is redder (color2).
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// What the colour needs of a layer of scales.
typedef struct ScaleTone {
    float level; // 0..1: of the scale
    float own;   // 0..1, random per scale
    float under; // how near a higher scale is: its shadow
    float lip;   // how near its own edge over a lower scale is
} ScaleTone;

// Adds a layer of scales of these sizes (m), with relief of about this height.
static ScaleTone add_layer(BarkLook *look, const StemPlace *place, float around, float along,
                           float height, uint32_t seed)
{
    Vec3 torn, frayed, q = stem_lookup(place, around, along);
    noise_solid(vec3_scale(q, 1.3f), seed + 1, &torn);
    noise_solid(vec3_scale(q, 5.3f), seed + 2, &frayed);
    q = vec3_madd(vec3_madd(q, 0.14f, torn), 0.035f, frayed);
    CellPoint cell = noise_cells(q, seed);
    const float width = 0.09f, lift = 0.45f;
    float level = noise_unit(cell.cell, 5);
    float step = 0.5f * (level - noise_unit(cell.next, 5)); // from the middle of the step
    float t = clampf(cell.border / width, 0.0f, 1.0f);
    float off = lift * t * t * (3.0f - 2.0f * t), change = lift * 6.0f * t * (1.0f - t);
    float rise = level - 0.5f - step * (1.0f - t) * (1.0f - t) + off * cell.point.z;
    float slope = t < 1.0f ? (2.0f * step * (1.0f - t) + change * cell.point.z) / width : 0.0f;
    stem_add_relief(look, place, height * rise, height * slope, around, along, cell.normal);
    look->slope_v -= height * off / along;
    float near = clampf(1.0f - cell.border / 0.17f, 0.0f, 1.0f);
    return (ScaleTone){.level = level,
                       .own = noise_unit(cell.cell, 6),
                       .under = near * clampf(-4.0f * step, 0.0f, 1.0f),
                       .lip = near * clampf(4.0f * step, 0.0f, 1.0f)};
}

BarkLook bark_scales(const Material *m, const StemPlace *place, float scale, float footprint)
{
    BarkLook look = {0};
    float broad = pattern_detail(0.05f * scale, footprint);
    float seen = pattern_detail(0.022f * scale, footprint);
    float thick = smoothstepf(0.01f, 0.06f, place->radius);
    float tone = noise_fractal(stem_lookup(place, 0.35f * scale, 0.8f * scale), 6, 48);
    ScaleTone large = add_layer(&look, place, 0.060f * scale, 0.085f * scale, 0.85f * thick, 31);
    ScaleTone small =
        add_layer(&look, place, 0.024f * scale, 0.032f * scale, 0.42f * seen * thick, 35);
    float level = 0.6f * large.level + 0.4f * lerpf(0.5f, small.level, seen);
    float value = 0.86f + 0.26f * tone + 0.30f * broad * (large.own - 0.5f) +
                  0.24f * seen * (small.own - 0.5f) + 0.30f * broad * (level - 0.5f);
    Vec3 grey = vec3_scale(m->color, value);
    float fresh = lerpf(0.25f, smoothstepf(0.50f, 0.22f, level), broad);
    Vec3 color = vec3_lerp(grey, vec3_scale(m->color2, value), fresh);
    float shadow = fmaxf(large.under, 0.8f * seen * small.under);
    float lip = fmaxf(large.lip, 0.8f * seen * small.lip);
    color = vec3_scale(color, 1.0f - 0.55f * broad * shadow + 0.14f * broad * lip);
    float twig = smoothstepf(0.012f, 0.006f, place->radius);
    look.color = vec3_lerp(color, vec3(0.16f, 0.12f, 0.075f), twig);
    return look;
}
