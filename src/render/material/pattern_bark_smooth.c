// The smooth skin of beeches: silver-grey, with fine grain and folds across the stem, colonies of
// crustose lichen, stains of running rain, and a film of algae where it is damp. Features of all
// sizes from half a metre to millimetres, so that some are as fine as the pixel from any distance.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// A lookup whose borders are ragged.
static Vec3 ragged(const StemPlace *place, float around, float along, uint32_t seed)
{
    Vec3 torn, frayed, q = stem_lookup(place, around, along);
    noise_solid(vec3_scale(q, 2.6f), seed, &torn);
    noise_solid(vec3_scale(q, 9.0f), seed, &frayed);
    return vec3_madd(vec3_madd(q, 0.09f, torn), 0.030f, frayed);
}

// Colonies of crustose lichen of a size (m): each of its own grey, pale as a rule, with a dark line
// where two meet; many together where it is light. seen: share of what is as fine.
static Vec3 add_colonies(Vec3 color, const StemPlace *place, float size, float seen, uint32_t seed)
{
    float where = noise_fractal(stem_lookup(place, 7.0f * size, 5.0f * size), 4, seed);
    Vec3 q = ragged(place, size, 0.75f * size, seed + 1);
    CellPoint colony = noise_cells_on(q, stem_out(place), seed + 2);
    if (noise_unit(colony.cell, 5) > 0.12f + 1.5f * where) {
        return color;
    }
    float line = seen * (1.0f - smoothstepf(0.015f, 0.06f, colony.border));
    float tone = lerpf(0.88f, 1.32f, noise_unit(colony.cell, 1)), hue = noise_unit(colony.cell, 2);
    Vec3 tint = vec3_lerp(vec3(0.99f, 1.04f, 0.91f), vec3(0.97f, 1.0f, 1.02f), hue);
    return vec3_mul(color, vec3_scale(tint, tone * (1.0f - 0.30f * line)));
}

// Dark stains where rain runs down the stem.
static Vec3 add_stains(Vec3 color, const StemPlace *place, float scale)
{
    float run = noise_fractal(stem_lookup(place, 0.17f * scale, 2.4f * scale), 5, 69);
    float sooty = noise_fractal(ragged(place, 0.22f * scale, 0.13f * scale, 65), 6, 56);
    float stain = smoothstepf(0.0f, 0.55f, 0.8f * run + 0.6f * sooty);
    return vec3_lerp(color, vec3_mul(color, vec3(0.58f, 0.60f, 0.56f)), stain);
}

// Small round crusts, some centimetres wide, and dark points. seen: share of what is as fine.
static Vec3 add_spots(Vec3 color, const StemPlace *place, float scale, float seen)
{
    CellPoint cell = noise_cells(ragged(place, 0.034f * scale, 0.030f * scale, 66), 67);
    float size = lerpf(0.12f, 0.42f, noise_unit(cell.cell, 2) * noise_unit(cell.cell, 3));
    float t = vec3_length(cell.point) / size;
    float share = noise_unit(cell.cell, 1) < 0.5f ? 1.0f - smoothstepf(0.75f, 1.05f, t) : 0.0f;
    float tone = 1.0f + seen * share * (0.26f * noise_unit(cell.cell, 4) - 0.04f);
    float dot = noise_solid(stem_lookup(place, 0.010f * scale, 0.007f * scale), 57, NULL);
    return vec3_scale(color, tone * (1.0f - 0.22f * seen * smoothstepf(0.30f, 0.55f, dot)));
}

// A film of algae: at the foot and on the side away from the sun (-z), thicker where rain runs.
static Vec3 add_algae(Vec3 color, const StemPlace *place, float scale)
{
    float north = -vec3_cross(place->u, place->v).z;
    float run = noise_fractal(stem_lookup(place, 0.35f * scale, 1.6f * scale), 5, 53);
    float foot = expf(-fmaxf(place->height, 0.0f) / (0.9f * scale));
    float film = 0.55f * smoothstepf(-0.1f, 0.9f, 0.55f * foot + 0.4f * north + 0.8f * run);
    return vec3_mul(color, vec3(1.0f - 0.36f * film, 1.0f - 0.20f * film, 1.0f - 0.55f * film));
}

// Adds a noise stretched across the stem to the relief and, by `tone`, to the colour.
static void add_grain(BarkLook *look, const StemPlace *place, float around, float along,
                      float height, float tone, uint32_t seed)
{
    Vec3 g;
    float n = noise_solid(stem_lookup(place, around, along), seed, &g);
    stem_add_relief(look, place, height * n, height, around, along, g);
    look->color = vec3_scale(look->color, 1.0f + tone * n);
}

// Folds of the skin across the stem, where it was pressed: in groups.
static void add_folds(BarkLook *look, const StemPlace *place, float scale, float seen)
{
    Vec3 bend, g, q = stem_lookup(place, 0.16f * scale, 0.022f * scale);
    float where = noise_fractal(stem_lookup(place, 0.5f * scale, 0.4f * scale), 2, 59);
    float share = seen * smoothstepf(0.0f, 0.35f, where);
    if (share <= 0.0f) {
        return;
    }
    noise_solid(vec3_scale(q, 0.4f), 62, &bend);
    float n = noise_solid(vec3_madd(q, 0.3f, bend), 61, &g);
    float crease = clampf(1.0f - fabsf(n) / 0.22f, 0.0f, 1.0f);
    float change = 2.0f * crease / 0.22f * (n < 0.0f ? -1.0f : 1.0f);
    stem_add_relief(look, place, -0.30f * share * crease * crease, 0.30f * share * change,
                    0.16f * scale, 0.022f * scale, g);
    look->color = vec3_scale(look->color, 1.0f - 0.22f * share * crease * crease);
}

BarkLook bark_smooth(const Material *m, const StemPlace *place, float scale, float footprint)
{
    BarkLook look = {0};
    float seen = pattern_detail(0.012f * scale, footprint);
    float broad = pattern_detail(0.05f * scale, footprint);
    float tone = noise_fractal(stem_lookup(place, 0.55f * scale, 0.40f * scale), 6, 51);
    look.color = vec3_scale(m->color, 1.0f + 0.26f * tone);
    look.color = add_stains(look.color, place, scale);
    look.color = add_colonies(look.color, place, 0.13f * scale, broad, 70);
    look.color = add_colonies(look.color, place, 0.045f * scale, seen, 74);
    look.color = add_spots(look.color, place, scale, broad);
    look.color = add_algae(look.color, place, scale);
    add_grain(&look, place, 0.16f * scale, 0.028f * scale, 0.30f * broad, 0.09f * broad, 63);
    add_grain(&look, place, 0.055f * scale, 0.008f * scale, 0.12f * seen, 0.13f * seen, 54);
    add_grain(&look, place, 0.022f * scale, 0.0032f * scale, 0.03f * seen, 0.10f * seen, 58);
    add_folds(&look, place, scale, broad);
    return look;
}
