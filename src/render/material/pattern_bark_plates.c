// Bark of pines: on old trunks thick plates, several times longer than wide, that flake in layers
// toward deep fissures; thin papery flakes on what is younger; grey scales on roots.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

#include <math.h>
#include <stddef.h>

// Scales that lie in layers: steps of a noise.
// Returns how near the place is to a step, 0..1. *tone: 0..1, random per layer.
static float add_scales(BarkLook *look, const StemPlace *place, float around, float along,
                        float height, float shift, uint32_t seed, float *tone)
{
    Vec3 g, torn, q = stem_lookup(place, around, along);
    noise_solid(vec3_scale(q, 4.7f), seed + 50, &torn); // ragged edges
    q = vec3_madd(q, 0.10f, torn);
    float n = 3.0f * noise_solid(vec3(q.x, q.y, q.z + 10.0f * shift), seed, &g);
    float step = n - floorf(n);
    float edge = clampf(1.0f - step / 0.16f, 0.0f, 1.0f);
    *tone = noise_unit((uint32_t)(int)floorf(n), (uint32_t)(1024.0f * shift));
    float rise = 0.08f * (floorf(n) + 1.0f - edge * edge); // the integral of edge over n
    stem_add_relief(look, place, height * rise, height * edge * 3.0f, around, along, g);
    return edge;
}

// Plates of the size that an old trunk has (size 1) or a thinner one.
static BarkLook old_plates(const Material *m, const StemPlace *place, float scale, float size,
                           float seen, Vec3 wind)
{
    BarkLook look = {0};
    BarkPlate p = bark_add_plates(&look, place, 0.092f * size * scale, 0.33f * size * scale, wind,
                                  size < 1.0f ? 141u : 41u);
    float tone, edge = add_scales(&look, place, 0.024f * scale, 0.075f * scale,
                                  0.42f * seen * p.rise, p.own, 42, &tone);
    float stain = noise_fractal(stem_lookup(place, 0.06f * scale, 0.14f * scale), 4, 47);
    float value = 0.82f + 0.30f * p.own + 0.45f * stain + 0.22f * (p.layer - 0.5f) +
                  (0.24f * (tone - 0.5f) - 0.13f * edge) * seen;
    float speck = noise_solid(stem_lookup(place, 0.008f * scale, 0.017f * scale), 50, NULL);
    value += 0.22f * seen * speck;
    Vec3 grey = vec3_scale(m->color, value);
    float bloom = p.rise * smoothstepf(0.05f, 0.6f, stain + 0.5f * (tone - 0.3f));
    grey = vec3_lerp(grey, vec3_mul(grey, vec3(1.22f, 1.34f, 1.46f)), 0.7f * bloom);
    // The outermost scales weather to grey; layers that a flake has left bare are warm.
    float bare = clampf(1.1f - p.rise, 0.0f, 1.0f) * (0.35f + 0.65f * p.layer);
    bare = fmaxf(bare, seen * smoothstepf(0.80f, 0.97f, tone) * 0.6f);
    float warm = clampf(0.02f + 0.42f * bare + 0.15f * stain + 0.14f * (p.own - 0.5f), 0.0f, 0.55f);
    Vec3 color = vec3_lerp(grey, vec3_scale(m->color2, 0.80f * value), warm);
    color = vec3_scale(color, 1.0f - 0.38f * p.edge);
    Vec3 deep = vec3_scale(vec3_lerp(m->color, m->color2, 0.40f), 0.10f);
    look.color = vec3_lerp(deep, color, smoothstepf(0.0f, 0.42f, p.rise));
    return look;
}

// Thin pieces at levels of their own, whose edges stand off. *lip: how near the own edge over a
// lower piece is; *under: how near a higher one; both 0..1. Returns the level, 0..1.
static float add_paper(BarkLook *look, const StemPlace *place, float around, float along,
                       float height, uint32_t seed, float *lip, float *under)
{
    Vec3 torn, frayed, q = stem_lookup(place, around, along);
    noise_solid(vec3_scale(q, 1.2f), seed + 1, &torn);
    noise_solid(vec3_scale(q, 4.9f), seed + 2, &frayed);
    q = vec3_madd(vec3_madd(q, 0.22f, torn), 0.05f, frayed);
    CellPoint cell = noise_cells_on(q, stem_out(place), seed);
    const float width = 0.07f;
    float level = noise_unit(cell.cell, 5), step = level - noise_unit(cell.next, 5);
    float t = clampf(cell.border / width, 0.0f, 1.0f), near = 1.0f - t;
    // A step of half its height at the border, and a curl on the higher side.
    float curl = step > 0.0f ? step : 0.0f;
    float rise = level - 0.5f - 0.5f * step * near * near + 0.5f * curl * t * near;
    float slope = t < 1.0f ? (step * near + 0.5f * curl * (1.0f - 2.0f * t)) / width : 0.0f;
    stem_add_relief(look, place, height * rise, height * slope, around, along, cell.normal);
    *lip = clampf(3.0f * curl, 0.0f, 1.0f) * near;
    float shade = clampf(1.0f - cell.border / 0.14f, 0.0f, 1.0f);
    *under = clampf(-3.0f * step, 0.0f, 1.0f) * shade;
    return level;
}

// Thin papery bark. worn: 0..1, how near the old bark below it is.
static BarkLook young_flakes(const Material *m, const StemPlace *place, float scale, float seen,
                             float worn)
{
    BarkLook look = {0};
    float lip, under, lip2, under2;
    float broad = add_paper(&look, place, 0.045f * scale, 0.085f * scale, 0.13f, 44, &lip, &under);
    float fine =
        add_paper(&look, place, 0.017f * scale, 0.034f * scale, 0.06f * seen, 45, &lip2, &under2);
    float streak = noise_fractal(stem_lookup(place, 0.05f * scale, 0.5f * scale), 4, 48);
    float aged =
        smoothstepf(0.35f, 0.95f, 0.65f * broad + 0.35f * lerpf(0.5f, fine, seen) + 0.45f * streak);
    float value = 0.90f + 0.30f * streak + 0.16f * (broad - 0.5f) + 0.22f * seen * (fine - 0.5f);
    Vec3 buff = vec3_mul(m->color2, vec3(0.86f, 1.12f, 1.40f));
    Vec3 color = vec3_scale(vec3_lerp(m->color2, buff, 0.75f * aged), value);
    color = vec3_lerp(color, vec3_scale(m->color, 1.15f * value),
                      clampf(1.5f * worn * (0.4f + aged), 0.0f, 0.75f));
    float light = fmaxf(lip, 0.7f * lip2) * seen, dark = fmaxf(under, 0.7f * under2);
    color = vec3_lerp(color, vec3_mul(color, vec3(1.25f, 1.35f, 1.45f)), 0.55f * light);
    look.color = vec3_scale(color, 1.0f - 0.50f * dark * lerpf(0.5f, 1.0f, seen));
    return look;
}

static BarkLook mix_looks(BarkLook a, BarkLook b, float t)
{
    return (BarkLook){vec3_lerp(a.color, b.color, t), lerpf(a.height, b.height, t),
                      lerpf(a.slope_u, b.slope_u, t), lerpf(a.slope_v, b.slope_v, t)};
}

// How much of the bark is old: on thick stems, up to the height that the material tells, and on
// roots and the lowest foot.
static float age_of(const Material *m, const StemPlace *place, float scale, float turn)
{
    float radius = place->radius * (1.0f + 0.35f * turn);
    float thick = smoothstepf(0.075f, 0.125f, radius);
    if (m->bark_height > 0.0f) {
        float up = place->p.z / m->bark_height + 0.65f * turn;
        thick *= smoothstepf(1.6f, 0.5f, up); // plates end at about half of it, in tongues
    }
    float foot = smoothstepf(1.3f, 0.7f, place->p.z / scale + 0.2f * turn);
    return fmaxf(thick, fmaxf(foot, stem_root(place)));
}

BarkLook bark_plates(const Material *m, const StemPlace *place, float scale, float footprint)
{
    Vec3 wind;
    noise_solid(stem_lookup(place, 0.16f * scale, 0.5f * scale), 40, &wind);
    float seen = pattern_detail(0.03f * scale, footprint);
    float turn = noise_solid(stem_lookup(place, 0.17f * scale, 1.0f * scale), 46, NULL) +
                 0.5f * noise_solid(stem_lookup(place, 0.06f * scale, 0.22f * scale), 49, NULL);
    float age = age_of(m, place, scale, turn), old = smoothstepf(0.4f, 0.6f, age);
    float coarse = smoothstepf(0.10f, 0.15f, place->radius);
    BarkLook look = {0};
    if (old > 0.0f) {
        BarkLook fine = {0}, large = {0};
        if (coarse < 1.0f) {
            fine = old_plates(m, place, scale, 0.45f, seen, wind);
        }
        if (coarse > 0.0f) {
            large = old_plates(m, place, scale, 1.0f, seen, wind);
        }
        look = mix_looks(fine, large, coarse);
    }
    if (old < 1.0f) {
        BarkLook flakes = young_flakes(m, place, scale, seen, age);
        flakes.height += 0.5f; // the fissures of old bark lie lower, its plates higher
        look = mix_looks(flakes, look, old);
    }
    float twig = smoothstepf(0.012f, 0.006f, place->radius) * (1.0f - stem_root(place));
    look.color = vec3_lerp(look.color, vec3(0.16f, 0.12f, 0.075f), twig);
    look.color = stem_earth(place, look.color);
    return look;
}
