// Barks with marks across the stem: the white one of birches and the glossy one of cherries.
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

// Black, rugged patches: a foot that is all black, diamonds above it, and few of them high up.
static float diamonds(const StemPlace *place, float scale, Vec3 torn, float *border)
{
    Vec3 q = vec3_madd(stem_lookup(place, 0.13f * scale, 0.34f * scale), 0.16f, torn);
    CellPoint cell = noise_cells(q, 21);
    float old = smoothstepf(0.04f, 0.11f, place->radius);
    float foot = expf(-fmaxf(place->height, 0.0f) / (5.0f * place->radius + 0.05f));
    float share = old * clampf(0.10f + 0.9f * foot, 0.0f, 1.0f);
    float chance = noise_unit(cell.cell, 3);
    // As the share grows, more cells are black, and their black parts larger.
    float size = clampf((share - chance * 0.75f) * 2.2f, 0.0f, 1.2f);
    float edge = 0.42f - 0.55f * size;
    *border = cell.border - edge;
    return size > 0.0f ? smoothstepf(0.0f, 0.06f, *border) : 0.0f;
}

// The fissured black bark inside the patches.
static Vec3 add_black(BarkLook *look, const Material *m, const StemPlace *place, float scale,
                      float black)
{
    Vec3 g;
    float n = noise_solid(stem_lookup(place, 0.018f * scale, 0.06f * scale), 24, &g);
    float ridge = 1.0f - fabsf(n);
    float sign = n < 0.0f ? black : -black;
    stem_add_relief(look, place, -0.8f * black * fabsf(n), 0.8f * sign, 0.018f * scale,
                    0.06f * scale, g);
    return vec3_scale(m->color2, 0.4f + 1.3f * ridge * ridge);
}

// Thin sheets that come off in bands across: their lower side and the skin below are salmon.
static Vec3 add_peeling(BarkLook *look, const StemPlace *place, float scale, Vec3 white)
{
    const float around = 0.17f * scale, along = 0.05f * scale;
    Vec3 g;
    float n = noise_solid(stem_lookup(place, around, along), 27, &g);
    float fresh = smoothstepf(0.34f, 0.40f, n);
    float edge = clampf(1.0f - fabsf(n - 0.36f) / 0.035f, 0.0f, 1.0f);
    float step = clampf(n - 0.325f, 0.0f, 0.07f); // its height is the integral of edge
    float rise =
        step < 0.035f ? step * step / 0.07f : 0.035f - (0.07f - step) * (0.07f - step) / 0.07f;
    stem_add_relief(look, place, -0.5f * rise, -0.5f * edge, around, along, g);
    Vec3 salmon = vec3_mul(white, vec3(0.98f, 0.84f, 0.70f));
    Vec3 color = vec3_lerp(white, salmon, 0.8f * fresh);
    return vec3_scale(color, 1.0f - 0.35f * edge);
}

static Vec3 young_birch(float gloss)
{
    return vec3_scale(vec3(0.145f, 0.062f, 0.038f), 0.9f + 0.25f * gloss);
}

BarkLook bark_birch(const Material *m, const StemPlace *place, float scale, float footprint)
{
    BarkLook look = {0};
    Vec3 torn, g;
    float tone = noise_solid(stem_lookup(place, 0.3f * scale, 0.12f * scale), 22, NULL);
    noise_solid(stem_lookup(place, 0.05f * scale, 0.09f * scale), 23, &torn);
    Vec3 white = vec3_scale(m->color, 0.96f + 0.10f * tone);
    float fine = pattern_detail(0.012f * scale, footprint);
    if (fine > 0.0f) {
        white = vec3_lerp(white, add_peeling(&look, place, scale, white), fine);
        float rise, line = dashes(place, 0.05f * scale, 0.0085f * scale, 0.30f, 25, &g, &rise);
        float fade = fine * smoothstepf(-0.35f, 0.3f, tone);
        stem_add_relief(&look, place, 0.10f * rise * fade, 0.10f * line * fade, 0.05f * scale,
                        0.0085f * scale, g);
        white = vec3_lerp(white, vec3_scale(m->color2, 2.2f), 0.72f * line * fade);
    }
    float border, black = diamonds(place, scale, torn, &border);
    if (black > 0.0f) {
        white = vec3_lerp(white, add_black(&look, m, place, scale, black), black);
    }
    float old = smoothstepf(0.012f, 0.035f, place->radius);
    look.color = vec3_lerp(young_birch(tone), white, old);
    look.height *= old;
    look.slope_u *= old;
    look.slope_v *= old;
    return look;
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
