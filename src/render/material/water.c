// Open water: a dielectric surface with the waves of a sea (base/waves.h) and their foam. What of
// the waves is finer than a pixel is roughness.
//
// Light finds its way into the body straight through the surface, without refraction
// (TRAIT_OPEN): so the sun lights the bed and the water without noise. See path_surface.c.
#include "base/memory.h"
#include "base/waves.h"
#include "render/material/bsdf_ggx.h"
#include "render/material/dielectric.h"
#include "render/material/maps.h"
#include "render/material/material_ops.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"
#include "render/warp.h"

#include <stddef.h>

// What holes of foam are before the pixel is wide enough to show none of them.
typedef struct FoamScale {
    float size; // m: of the holes
    uint32_t seed;
} FoamScale;

// Share of the pixel that strands between holes cover, which reach `half` of a hole's size from the
// middle of a strand; 0.5 fills the holes.
static float strands(const FoamScale *scale, Vec2 at, float half, float width)
{
    float seen = pattern_detail(scale->size, width), mean = clampf(1.8f * half, 0.0f, 1.0f);
    if (seen <= 0.0f) {
        return mean;
    }
    Vec3 p = {at.x / scale->size, 0.5f, at.y / scale->size}, bend = vec3_scale(p, 1.9f);
    p.x += 0.3f * noise_solid(bend, scale->seed + 1, NULL);
    p.z += 0.3f * noise_solid(bend, scale->seed + 2, NULL);
    float border = noise_cells(p, scale->seed).border;
    return lerpf(mean, 1.0f - smoothstepf(half - 0.04f, half + 0.1f, border), seen);
}

// Share of the pixel that is foam where foam covers this share of the water about it: patches that
// fray and are torn into lace, coarse and fine.
static float foam_of(float cover, Vec2 at, float width)
{
    static const FoamScale coarse = {1.5f, 811}, fine = {0.35f, 821};
    if (cover <= 0.0f) {
        return 0.0f;
    }
    float ragged = noise_fractal(vec3(at.x / 5.0f, 0.3f, at.y / 5.0f), 6, 831);
    float dense = clampf(cover + 1.1f * (cover + 0.1f) * ragged - 0.06f, 0.0f, 1.0f);
    float lace = strands(&coarse, at, 0.5f * dense - 0.04f, width);
    float film = strands(&fine, at, 0.55f * dense, width);
    return smoothstepf(0.0f, 0.25f, dense) *
           fmaxf(lace * (0.35f + 0.65f * film), dense * dense * film);
}

static void shade(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, Vec3 wo)
{
    b->foam = 0.0f;
    b->foam_color = entry->material.color2;
    if (!point->waves || !point->has_uv) {
        return;
    }
    // A pixel is longer along the view than across.
    float cosine = fmaxf(fabsf(vec3_dot(surface_smooth_normal(point), wo)), 0.02f);
    float width = point->footprint / sqrtf(cosine);
    WavePoint wave;
    waves_at(point->waves, point->uv.x, point->uv.y, width, &wave);
    Vec3 normal = point->backface ? vec3_neg(wave.normal) : wave.normal;
    float facing = vec3_dot(normal, wo);
    // Slopes that turn away are hidden by others, which face the viewer.
    b->normal = facing < 0.0f ? vec3_madd(normal, -2.0f * facing, wo) : normal;
    b->foam = foam_of(waves_foam(point->waves, &wave), point->uv, point->footprint);
    // The core of GGX is as wide as that of a Gaussian of these slopes; its tails are wider.
    float alpha = 0.75f * sqrtf(wave.roughness2);
    b->roughness = sqrtf(clampf(fmaxf(alpha, b->alpha), 0.0f, 0.5f));
}

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    maps_set_roughness(entry, b->roughness, b);
    dielectric_prepare(b, entry, point, cos_o);
}

static Vec3 eval(const Bsdf *b, Vec3 wo, Vec3 wi, float *pdf)
{
    Vec3 f = dielectric_eval(b, wo, wi, pdf);
    if (b->foam <= 0.0f) {
        return f;
    }
    float cosine = fmaxf(vec3_dot(b->normal, wi), 0.0f) * (1.0f / PI_F);
    *pdf = lerpf(*pdf, cosine, b->foam);
    return vec3_lerp(f, vec3_scale(b->foam_color, cosine), b->foam);
}

static bool draw(const Bsdf *b, Vec3 wo, const float u[3], Vec3 *wi)
{
    if (u[2] < b->foam) {
        *wi = warp_cosine(b->normal, u[0], u[1]);
        return true;
    }
    const float rest[3] = {u[0], u[1], fminf((u[2] - b->foam) / (1.0f - b->foam), 0.99999994f)};
    return dielectric_draw(b, wo, rest, wi);
}

static bool tabulate(MaterialEntry *entry, MaterialSet *set, Error *e)
{
    (void)set;
    entry->alpha = entry->material.roughness * entry->material.roughness;
    entry->rough_tables = memory_alloc_zero(ROUGH_TABLES, sizeof *entry->rough_tables, e);
    for (int i = 0; entry->rough_tables && i < ROUGH_TABLES; i++) {
        float roughness = (float)i / (float)(ROUGH_TABLES - 1);
        ggx_table_dielectric(&entry->rough_tables[i], fmaxf(roughness * roughness, LEAST_ALPHA),
                             entry->material.ior);
    }
    return entry->rough_tables;
}

static void describe(const Material *m, Appearance *a)
{
    a->ior = m->ior;
}

static void defaults(Material *m)
{
    m->color = vec3_splat(1.0f);
    m->color2 = vec3_splat(0.6f);
    m->roughness = 0.0f;
    m->ior = 1.34f;
}

const MaterialOps water_ops = {.traits = TRAIT_BODY | TRAIT_OPEN,
                               .defaults = defaults,
                               .describe = describe,
                               .tabulate = tabulate,
                               .shade = shade,
                               .prepare = prepare,
                               .eval = eval,
                               .draw = draw};
