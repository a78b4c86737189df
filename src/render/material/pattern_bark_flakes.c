// Barks that come off: the patches of planes and eucalypts, the strips of cypresses.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// The age of the patch at the place, and the step to the next one: old patches are thick. *edge:
// how near a thicker one is, 0..1.
static float patch_age(BarkLook *look, const StemPlace *place, float around, float along,
                       float height, Vec3 wind, uint32_t seed, float *edge)
{
    Vec3 q = vec3_madd(stem_lookup(place, around, along), 0.38f, wind);
    CellPoint cell = noise_cells(q, seed);
    const float width = 0.022f;
    float t = clampf(cell.border / width, 0.0f, 1.0f), age = noise_unit(cell.cell, 8);
    float step = 0.5f * (age - noise_unit(cell.next, 8)); // from the middle of the step
    *edge = step < 0.0f ? clampf(1.0f - cell.border / 0.05f, 0.0f, 1.0f) : 0.0f;
    float rise = height * (age - step * (1.0f - t) * (1.0f - t) - 0.5f);
    float slope = height * step * 2.0f * (1.0f - t) / width;
    stem_add_relief(look, place, rise, slope, around, along, cell.normal);
    return age;
}

// Fresh patches are pale; they green and then brown with age. Old trunks keep old bark at the foot.
static Vec3 patch_color(const Material *m, float age)
{
    Vec3 olive = vec3_mul(vec3_lerp(m->color, m->color2, 0.55f), vec3(0.95f, 1.02f, 0.84f));
    return age < 0.5f ? vec3_lerp(m->color, olive, smoothstepf(0.15f, 0.45f, age))
                      : vec3_lerp(olive, m->color2, smoothstepf(0.5f, 0.75f, age));
}

BarkLook bark_flakes(const Material *m, const StemPlace *place, float scale, float footprint)
{
    BarkLook look = {0};
    Vec3 wind;
    float edge, edge2, seen = pattern_detail(0.03f * scale, footprint);
    noise_solid(stem_lookup(place, 0.10f * scale, 0.13f * scale), 61, &wind);
    float size = scale * (0.5f + 0.5f * smoothstepf(0.02f, 0.12f, place->radius));
    float large = patch_age(&look, place, 0.16f * size, 0.24f * size, 1.0f, wind, 62, &edge);
    float small = patch_age(&look, place, 0.055f * size, 0.085f * size, 0.5f, wind, 63, &edge2);
    float foot = smoothstepf(0.15f, 0.4f, place->radius) *
                 expf(-fmaxf(place->height, 0.0f) / (6.0f * place->radius + 0.05f));
    float age = clampf(0.62f * large + 0.38f * small + 0.5f * foot, 0.0f, 1.0f);
    float grain = noise_solid(stem_lookup(place, 0.02f * scale, 0.02f * scale), 64, NULL);
    look.color = vec3_scale(patch_color(m, age), 1.0f + 0.07f * seen * grain);
    look.color = vec3_scale(look.color, 1.0f - 0.30f * seen * fmaxf(edge, 0.6f * edge2));
    float twig = smoothstepf(0.02f, 0.008f, place->radius);
    look.color = vec3_lerp(look.color, vec3_lerp(m->color, m->color2, 0.8f), twig);
    return look;
}

BarkLook bark_fibrous(const Material *m, const StemPlace *place, float scale, float footprint)
{
    BarkLook look = {0};
    Vec3 bend, g, h;
    noise_solid(stem_lookup(place, 0.10f * scale, 0.5f * scale), 71, &bend);
    float seen = pattern_detail(0.012f * scale, footprint);
    const float around = 0.030f * scale, along = 0.42f * scale;
    Vec3 q = vec3_madd(stem_lookup(place, around, along), 0.35f, bend);
    float n = noise_solid(q, 72, &g), ridge = 1.0f - 1.4f * fabsf(n);
    stem_add_relief(&look, place, -0.9f * fabsf(n), n < 0.0f ? 0.9f : -0.9f, around, along, g);
    float fibre = noise_solid(stem_lookup(place, 0.0065f * scale, 0.16f * scale), 73, &h);
    stem_add_relief(&look, place, 0.16f * seen * fibre, 0.16f * seen, 0.0065f * scale,
                    0.16f * scale, h);
    // Strips whose ends come off: brighter and redder where they are fresh.
    float strip = noise_solid(stem_lookup(place, 0.05f * scale, 0.22f * scale), 74, NULL);
    Vec3 red = vec3_lerp(m->color, m->color2, 0.5f);
    Vec3 color = vec3_lerp(m->color, red, smoothstepf(0.1f, 0.5f, strip));
    color = vec3_lerp(vec3_scale(m->color2, 0.35f), color, smoothstepf(0.25f, 0.9f, ridge));
    look.color = vec3_scale(color, 1.0f + 0.22f * seen * fibre);
    return look;
}
