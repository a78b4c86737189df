// Bark of old olives, apples and other small slow trees: plates of several sizes, some whole, some
// broken into small ones, with fine fissures along the grain and thin flakes on them; stretches of
// young bark between, which is a skin in long strips; grey where it weathers, sooty and pale crusts
// of lichen. Thin branches are smooth.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// What a level of plates tells the colour.
typedef struct Cracked {
    float rise; // 0 at the bottom of a deep crack, 1 on top
    float top;  // 0 at the plate's border, 1 beyond the walls of its cracks
    float own;  // 0..1: random, per plate
} Cracked;

// Plates of these sizes (m) in all that is there already: cracks of this depth, each plate by up to
// `levels` of it above or below the others. width: of the cracks, in plates.
static Cracked add_level(BarkLook *look, const StemPlace *place, Vec3 size, float depth,
                         float levels, float width, Vec3 wind, uint32_t seed)
{
    float around = size.x, along = size.y;
    Vec3 torn, frayed, q = vec3_madd(stem_lookup(place, around, along), 0.40f, wind);
    noise_solid(vec3_scale(q, 2.3f), seed + 1, &torn);
    noise_solid(vec3_scale(q, 7.1f), seed + 2, &frayed);
    q = vec3_madd(vec3_madd(q, 0.105f, torn), 0.026f, frayed);
    CellPoint cell = noise_cells_on(q, stem_out(place), seed);
    // Cracks across the grain are narrower and shallower.
    float nu = vec3_dot(cell.normal, place->along_u), lengthwise = nu * nu;
    float wall = width * lerpf(0.45f, 1.0f, lengthwise), deep = lerpf(0.45f, 1.0f, lengthwise);
    float t = clampf(cell.border / wall, 0.0f, 1.0f), left = 1.0f - t;
    Cracked c = {.top = 1.0f - left * left, .own = noise_unit(cell.cell, 3)};
    c.rise = 1.0f - deep * left * left;
    float step = depth * (deep + levels * (c.own - 0.5f)), slope = 2.0f * left / wall;
    stem_add_relief(look, place, step * c.top - deep * depth, step * slope, around, along,
                    cell.normal);
    return c;
}

// Fissures where a noise stretched along the grain passes through zero. shift: another one on each
// plate. Returns 0..1: how deep in one the place is.
static float add_fissures(BarkLook *look, const StemPlace *place, float around, float along,
                          float depth, float shift, uint32_t seed)
{
    const float width = 0.22f;
    Vec3 g, q = stem_lookup(place, around, along);
    float n = noise_solid(vec3(q.x, q.y, q.z + 7.0f * shift), seed, &g);
    float in = clampf(1.0f - fabsf(n) / width, 0.0f, 1.0f);
    float slope = 2.0f * depth * in / width * (n < 0.0f ? -1.0f : 1.0f);
    stem_add_relief(look, place, -depth * in * in, slope, around, along, g);
    return in * in;
}

// Grain as fine as flakes of bark.
static float add_flakes(BarkLook *look, const StemPlace *place, float scale, float height)
{
    Vec3 g;
    float around = 0.006f * scale, along = 0.011f * scale;
    float n = noise_solid(stem_lookup(place, around, along), 171, &g);
    float side = n < 0.0f ? 1.6f : 0.7f; // dents are sharper than bulges
    stem_add_relief(look, place, height * side * n, height * side, around, along, g);
    return side * n;
}

// Stains, the grey of weathered tops, crusts of lichen. up: 0..1, how far out the place stands.
static Vec3 weathered(const Material *m, const StemPlace *place, float scale, float value, float up)
{
    float stain = noise_fractal(stem_lookup(place, 0.10f * scale, 0.34f * scale), 5, 172);
    Vec3 color = vec3_scale(m->color, value * (1.0f + 0.45f * stain));
    float grey = 0.37f * (color.x + color.y + color.z);
    Vec3 silver = vec3(1.02f * grey, 1.02f * grey, 1.0f * grey);
    color = vec3_lerp(color, silver, 0.9f * smoothstepf(0.25f, 0.95f, up - 0.5f * stain));
    float crust = noise_fractal(stem_lookup(place, 0.045f * scale, 0.05f * scale), 5, 173);
    float where = noise_solid(stem_lookup(place, 0.4f * scale, 0.5f * scale), 174, NULL);
    float pale = smoothstepf(0.16f, 0.26f, crust + 0.25f * where - 0.06f) * up;
    color = vec3_lerp(color, vec3_mul(silver, vec3(1.30f, 1.38f, 1.22f)), 0.55f * pale);
    float soot = smoothstepf(0.10f, 0.42f, -crust - 0.35f * where);
    return vec3_scale(color, 1.0f - 0.45f * soot);
}

// A skin that is stretched: long shallow strips.
static BarkLook young_bark(const Material *m, const StemPlace *place, float scale, float seen)
{
    BarkLook look = {0};
    float strip = noise_solid(stem_lookup(place, 0.03f * scale, 0.4f * scale), 175, NULL);
    float in = add_fissures(&look, place, 0.022f * scale, 0.13f * scale, 0.16f, 0.0f, 176);
    float grain = seen * add_flakes(&look, place, 1.3f * scale, 0.05f * seen);
    float value = 1.04f + 0.16f * strip + 0.08f * grain;
    Vec3 skin = weathered(m, place, scale, value, 0.55f);
    skin = vec3_mul(skin, vec3(0.98f, 1.02f, 0.94f));
    look.color = vec3_lerp(skin, m->color2, 0.5f * in);
    look.height += 0.72f; // about the mean of old bark
    return look;
}

static BarkLook old_bark(const Material *m, const StemPlace *place, float scale, float seen,
                         Vec3 wind)
{
    BarkLook look = {.height = 1.0f};
    float wide = 0.22f + 0.10f * wind.x;
    Cracked large = add_level(&look, place, vec3(0.050f * scale, 0.19f * scale, 0.0f), 0.62f, 0.5f,
                              wide, wind, 161);
    // Some plates are broken more than others.
    float broken = large.top * smoothstepf(-0.25f, 0.6f, large.own + 0.7f * wind.y - 0.15f);
    Cracked small = add_level(&look, place, vec3(0.019f * scale, 0.041f * scale, 0.0f),
                              0.30f * broken, 0.9f, 0.20f, vec3_scale(wind, 2.1f), 163);
    float part = broken * small.top;
    float fissure = 0.7f * large.top *
                    add_fissures(&look, place, 0.017f * scale, 0.10f * scale, 0.15f * large.top,
                                 large.own, 165);
    float grain = 0.0f;
    if (seen > 0.0f) {
        fissure += 0.6f * seen * part *
                   add_fissures(&look, place, 0.0065f * scale, 0.045f * scale, 0.07f * seen * part,
                                small.own, 166);
        grain = seen * add_flakes(&look, place, scale, 0.05f * seen);
    }
    float value =
        0.78f + large.top * 0.32f * large.own + part * 0.34f * (small.own - 0.5f) + 0.14f * grain;
    float up = large.rise * (1.0f - 0.6f * broken * (1.0f - small.rise)) *
               (1.0f - 0.8f * fminf(fissure, 1.0f));
    Vec3 color = weathered(m, place, scale, value, up);
    // Walls of cracks show the warmer inner bark.
    float wall = 4.0f * up * (1.0f - up);
    color = vec3_mul(color, vec3(1.0f, 1.0f - 0.07f * wall, 1.0f - 0.16f * wall));
    look.color = vec3_lerp(m->color2, color, smoothstepf(0.05f, 0.6f, up));
    return look;
}

// 0..1: how much of the bark is old here.
static float age_of(const StemPlace *place, float scale)
{
    float turn = noise_fractal(stem_lookup(place, 0.20f * scale, 0.75f * scale), 3, 168);
    return smoothstepf(0.035f, 0.09f, place->radius) * smoothstepf(-0.41f, -0.19f, turn);
}

BarkLook bark_gnarled(const Material *m, const StemPlace *place, float scale, float footprint)
{
    Vec3 wind;
    noise_solid(stem_lookup(place, 0.15f * scale, 0.33f * scale), 160, &wind);
    wind = vec3_scale(wind, 0.6f);
    float seen = pattern_detail(0.012f * scale, footprint), old = age_of(place, scale);
    BarkLook look = {0};
    if (old > 0.0f) {
        look = old_bark(m, place, scale, seen, wind);
    }
    if (old < 1.0f) {
        BarkLook young = young_bark(m, place, scale, seen);
        look = (BarkLook){
            vec3_lerp(young.color, look.color, old), lerpf(young.height, look.height, old),
            lerpf(young.slope_u, look.slope_u, old), lerpf(young.slope_v, look.slope_v, old)};
    }
    // Soil lies in the cracks; rain washes the plates.
    float washed = 0.7f * smoothstepf(0.45f, 0.85f, look.height);
    look.color = vec3_lerp(stem_earth(place, look.color), look.color, washed);
    return look;
}
