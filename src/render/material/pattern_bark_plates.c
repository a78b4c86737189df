// Bark of pines: thick plates of thin scales between dark furrows on old trunks, and papery orange
// flakes on what is younger.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// Cells of these sizes (m) with a groove of `wall` of a cell's size around each; the height of
// their relief is 1. Returns 1 on a plate, 0 in the groove.
static float add_cells(BarkLook *look, const StemPlace *place, float around, float along,
                       float wall, float height, Vec3 wind, uint32_t seed, CellPoint *cell)
{
    Vec3 torn, q = vec3_madd(stem_lookup(place, around, along), 0.42f, wind);
    noise_solid(vec3_scale(stem_lookup(place, around, along), 3.3f), seed + 2, &torn);
    q = vec3_madd(q, 0.045f, torn);
    *cell = noise_cells(q, seed);
    float t = clampf(cell->border / wall, 0.0f, 1.0f);
    float slope = t < 1.0f ? 2.0f * (1.0f - t) / wall : 0.0f;
    float rise = t * (2.0f - t);
    stem_add_relief(look, place, height * rise, height * slope, around, along, cell->normal);
    return rise;
}

// Scales that lie in layers: steps of a noise.
// Returns how near the place is to a step, 0..1. *tone: 0..1, random per layer.
static float add_scales(BarkLook *look, const StemPlace *place, float around, float along,
                        float height, float shift, uint32_t seed, float *tone)
{
    Vec3 g, torn, q = stem_lookup(place, around, along);
    noise_solid(vec3_scale(q, 4.7f), seed + 50, &torn); // ragged edges
    q = vec3_madd(q, 0.045f, torn);
    float n = 3.0f * noise_solid(vec3(q.x, q.y, q.z + 10.0f * shift), seed, &g);
    float step = n - floorf(n);
    float edge = clampf(1.0f - step / 0.16f, 0.0f, 1.0f);
    *tone = noise_unit((uint32_t)(int)floorf(n), (uint32_t)(1024.0f * shift));
    float rise = 0.08f * (floorf(n) + 1.0f - edge * edge); // the integral of edge over n
    stem_add_relief(look, place, height * rise, height * edge * 3.0f, around, along, g);
    return edge;
}

static BarkLook old_plates(const Material *m, const StemPlace *place, float scale, float seen,
                           Vec3 wind)
{
    BarkLook look = {0};
    CellPoint cell;
    const float around = 0.055f * scale, along = 0.12f * scale;
    float plate =
        add_cells(&look, place, around, along, 0.10f + 0.06f * wind.x, 1.0f, wind, 41, &cell);
    float own = noise_unit(cell.cell, 5);
    float tone, edge = add_scales(&look, place, 0.030f * scale, 0.055f * scale, 0.75f * seen, own,
                                  42, &tone);
    float stain = noise_fractal(stem_lookup(place, 0.05f * scale, 0.08f * scale), 3, 47);
    Vec3 grey = vec3_scale(m->color, 0.80f + 0.35f * own + 0.45f * stain +
                                         (0.26f * (tone - 0.5f) - 0.18f * edge) * seen);
    Vec3 flesh = vec3_lerp(grey, m->color2,
                           clampf(0.22f * noise_unit(cell.cell, 6) + 0.2f * stain, 0.0f, 1.0f));
    Vec3 furrow = vec3_scale(vec3_lerp(m->color, m->color2, 0.35f), 0.26f);
    look.color = vec3_lerp(furrow, flesh, smoothstepf(0.15f, 0.9f, plate));
    return look;
}

static BarkLook young_flakes(const Material *m, const StemPlace *place, float scale, float seen,
                             Vec3 wind)
{
    BarkLook look = {0};
    CellPoint cell;
    const float around = 0.028f * scale, along = 0.045f * scale;
    float flake = add_cells(&look, place, around, along, 0.06f, 0.12f * seen, wind, 44, &cell);
    float own = noise_unit(cell.cell, 5);
    float tone,
        edge = add_scales(&look, place, 0.05f * scale, 0.06f * scale, 0.15f * seen, own, 45, &tone);
    Vec3 color = vec3_scale(m->color2, 0.8f + 0.3f * own + 0.3f * seen * (tone - 0.5f));
    color = vec3_lerp(color, vec3_mul(color, vec3(1.2f, 1.35f, 1.5f)), 0.35f * edge * seen);
    look.color = vec3_scale(color, 1.0f - 0.35f * seen * (1.0f - flake));
    return look;
}

BarkLook bark_plates(const Material *m, const StemPlace *place, float scale, float footprint)
{
    Vec3 wind;
    noise_solid(stem_lookup(place, 0.16f * scale, 0.3f * scale), 40, &wind);
    float seen = pattern_detail(0.03f * scale, footprint);
    float turn = noise_solid(stem_lookup(place, 0.4f * scale, 0.7f * scale), 46, NULL);
    float old = smoothstepf(0.075f, 0.125f, place->radius * (1.0f + 0.35f * turn));
    BarkLook look = {0};
    BarkLook plates = old > 0.0f ? old_plates(m, place, scale, seen, wind) : look;
    BarkLook flakes = old < 1.0f ? young_flakes(m, place, scale, seen, wind) : look;
    look = (BarkLook){
        vec3_lerp(flakes.color, plates.color, old), lerpf(flakes.height, plates.height, old),
        lerpf(flakes.slope_u, plates.slope_u, old), lerpf(flakes.slope_v, plates.slope_v, old)};
    float twig = smoothstepf(0.012f, 0.006f, place->radius);
    look.color = vec3_lerp(look.color, vec3(0.16f, 0.12f, 0.075f), twig);
    return look;
}
