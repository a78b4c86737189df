// Open water: a dielectric surface with the waves of a sea (base/waves.h) and their foam, or with
// the ripples of wind on a lake (wind_ripples.h). What of them is finer than a pixel is roughness.
// Without any it is a mirror: even a narrow lobe would spread what is ten thousand times as bright
// as the rest, a bolt, over many pixels.
//
// Light finds its way into the body straight through the surface, without refraction
// (TRAIT_OPEN): so the sun lights the bed and the water without noise. See path_surface.c.
#include "base/memory.h"
#include "base/waves.h"
#include "render/material/bsdf_ggx.h"
#include "render/material/dielectric.h"
#include "render/material/foam.h"
#include "render/material/maps.h"
#include "render/material/material_ops.h"
#include "render/material/wind_ripples.h"
#include "render/warp.h"

#include <math.h>
#include <stddef.h>

// Share of what foam scatters that leaves on its far side: lace is millimetres thick, froth
// decimetres.
#define LACE_THROUGH 0.36f
#define FROTH_THROUGH 0.16f
// Length that a metre along the wind has in the coordinates of patches and large holes: what a
// crest leaves is drawn out by those that follow.
#define SEA_DRAWN 0.5f

// Foam and what lies below it: bubbles that a breaker or a fall has taken down pale the water
// around it, softly, in the colour `plume`. Sets the share of the pixel that scatters light at
// once, and its reflectance. cover: of the surroundings; foam: of the pixel.
static void whiten(Bsdf *b, float cover, float foam, Vec3 plume)
{
    float below = (1.0f - foam) * 0.55f * cover;
    b->foam = foam + below;
    b->foam_color = vec3_scale(vec3_add(vec3_scale(b->foam_color, foam), vec3_scale(plume, below)),
                               1.0f / b->foam);
}

// normal: of the water; slope: of the foam on it, along `way`, unit in plan, and across.
static Vec3 foam_normal(Vec3 normal, Vec2 way, Vec2 slope)
{
    Vec3 along = vec3(way.x, 0.0f, way.y), across = vec3(-way.y, 0.0f, way.x);
    return vec3_normalize(vec3_madd(vec3_madd(normal, -slope.x, along), -slope.y, across));
}

// The fewer layers of bubbles foam has, the less it sends back.
static Vec3 foam_of(Vec3 color, float share, float fresh)
{
    const float thinnest = 0.5f; // of the reflectance of thick froth
    return vec3_scale(color, lerpf(thinnest, 1.0f, fmaxf(share, fresh)));
}

static void whiten_sea(Bsdf *b, const WavePoint *wave, const Waves *waves,
                       const SurfacePoint *point)
{
    const Vec3 plume = {0.10f, 0.27f, 0.26f}; // green
    WaveFoam foam = waves_foam(waves, wave);
    if (foam.bubbles > 0.0f) {
        Vec2 at = {point->uv.x * waves->way.x + point->uv.y * waves->way.y,
                   point->uv.y * waves->way.x - point->uv.x * waves->way.y};
        FoamCover cover = {foam.cover, foam.fresh};
        FoamPlace place = {{SEA_DRAWN * at.x, at.y}, at};
        float share = foam_share(cover, place, point->footprint);
        b->foam_color = foam_of(b->foam_color, share, foam.fresh);
        whiten(b, foam.bubbles, share, plume);
        Vec3 up = point->backface ? vec3_neg(b->normal) : b->normal;
        Vec2 slope = foam_slope(cover, share, place, SEA_DRAWN, point->footprint);
        up = foam_normal(up, waves->way, slope);
        b->foam_normal = point->backface ? vec3_neg(up) : up;
        b->foam_through = lerpf(LACE_THROUGH, FROTH_THROUGH, foam.fresh);
    }
}

// Reflectance of a river full of bubbles: light finds its way back out of them through some
// metres of water, which takes its own share.
static Vec3 river_plume(Vec3 absorption)
{
    const float white = 0.32f, way = 3.0f; // m
    return vec3(white * expf(-way * absorption.x), white * expf(-way * absorption.y),
                white * expf(-way * absorption.z));
}

// Slopes that turn away are hidden by others, which face the viewer.
static Vec3 turned_to(Vec3 normal, Vec3 wo)
{
    float facing = vec3_dot(normal, wo);
    return facing < 0.0f ? vec3_madd(normal, -2.0f * facing, wo) : normal;
}

// roughness2: variance of slopes, summed over both axes. The core of GGX is as wide as that of a
// Gaussian of these slopes; its tails are wider.
static void roughen(Bsdf *b, float roughness2)
{
    float alpha = 0.75f * sqrtf(roughness2);
    b->roughness = sqrtf(clampf(fmaxf(alpha, b->alpha), 0.0f, 0.5f));
}

static void ripple(Bsdf *b, const WindRipples *ripples, const SurfacePoint *point, Vec3 wo)
{
    float cosine = fmaxf(fabsf(vec3_dot(surface_smooth_normal(point), wo)), 0.02f);
    float level = sqrtf(wo.x * wo.x + wo.z * wo.z);
    Vec2 view = level > 1e-6f ? (Vec2){wo.x / level, wo.z / level} : (Vec2){1.0f, 0.0f};
    RipplePixel pixel = {view, point->footprint / cosine, point->footprint};
    Vec2 place = {point->object_position.x, point->object_position.z};
    RipplePoint at = wind_ripples_at(ripples, place, &pixel);
    Vec3 slope = vec3(at.slope.x, 0.0f, at.slope.y);
    // The slope is the water's: seen from below, it turns the normal, which points down, alike.
    b->normal =
        turned_to(vec3_normalize(vec3_madd(b->normal, point->backface ? 1.0f : -1.0f, slope)), wo);
    roughen(b, at.roughness2);
}

static void shade(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, Vec3 wo)
{
    b->foam_color = entry->material.color2;
    if (!point->waves || !point->has_uv) {
        if (entry->ripples) {
            ripple(b, entry->ripples, point, wo);
        }
        if (point->foam > 0.0f) {
            Vec3 plume = river_plume(entry->material.absorption);
            whiten(b, point->foam, b->foam, plume); // its pattern tells where foam lies
        }
        return;
    }
    // A pixel is longer along the view than across.
    float cosine = fmaxf(fabsf(vec3_dot(surface_smooth_normal(point), wo)), 0.02f);
    float width = point->footprint / sqrtf(cosine);
    WavePoint wave;
    waves_at(point->waves, point->uv.x, point->uv.y, width, &wave);
    Vec3 normal = point->backface ? vec3_neg(wave.normal) : wave.normal;
    b->normal = turned_to(normal, wo);
    whiten_sea(b, &wave, point->waves, point);
    roughen(b, wave.roughness2);
}

static void prepare(Bsdf *b, const MaterialEntry *entry, const SurfacePoint *point, float cos_o)
{
    maps_set_roughness(entry, b->roughness, b);
    bool mirror = b->roughness * b->roughness < LEAST_ALPHA && b->foam <= 0.0f;
    if (point->waves && point->has_uv) {
        // For the denoiser: water whose foam stands out.
        b->albedo = vec3_lerp(vec3_splat(0.25f), b->foam_color, b->foam);
    }
    if (b->foam_through <= 0.0f) {
        b->foam_normal = b->normal;
    } else if (vec3_dot(b->foam_normal, b->geometric_normal) < 0.05f) {
        b->foam_normal = b->normal;
    }
    b->alpha = mirror ? 0.0f : b->alpha;
    dielectric_prepare(b, entry, point, cos_o);
}

// Density of what foam scatters toward wi.
static float foam_density(const Bsdf *b, Vec3 wi)
{
    float cosine = vec3_dot(b->foam_normal, wi), share = 1.0f - b->foam_through;
    return cosine > 0.0f ? share * cosine / PI_F : -b->foam_through * cosine / PI_F;
}

static Vec3 eval(const Bsdf *b, Vec3 wo, Vec3 wi, float *pdf)
{
    Vec3 f = dielectric_eval(b, wo, wi, pdf);
    if (b->foam <= 0.0f) {
        return f;
    }
    float density = foam_density(b, wi);
    *pdf = lerpf(*pdf, density, b->foam);
    return vec3_lerp(f, vec3_scale(b->foam_color, density), b->foam);
}

static bool draw(const Bsdf *b, Vec3 wo, const float u[3], Vec3 *wi)
{
    if (u[2] < b->foam) {
        bool through = u[2] < b->foam * b->foam_through;
        *wi = warp_cosine(through ? vec3_neg(b->foam_normal) : b->foam_normal, u[0], u[1]);
        return true;
    }
    const float rest[3] = {u[0], u[1], fminf((u[2] - b->foam) / (1.0f - b->foam), 0.99999994f)};
    return dielectric_draw(b, wo, rest, wi);
}

static bool tabulate_ripples(MaterialEntry *entry, Error *e)
{
    const Material *m = &entry->material;
    float azimuth = m->wind_azimuth * RADIANS_PER_DEGREE;
    RippleWind wind = {.speed = m->wind,
                       .way = {-sinf(azimuth), cosf(azimuth)},
                       .calm = m->calm,
                       .gusts = m->gusts,
                       .longest = m->pattern_scale};
    if (m->wind <= 0.0f) {
        return true;
    }
    entry->ripples = memory_alloc(1, sizeof *entry->ripples, e);
    if (entry->ripples) {
        *entry->ripples = wind_ripples_of(&wind);
    }
    return entry->ripples;
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
    return entry->rough_tables && tabulate_ripples(entry, e);
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
    m->calm = 0.5f;
}

const MaterialOps water_ops = {.traits = TRAIT_BODY | TRAIT_OPEN | TRAIT_MIRROR,
                               .defaults = defaults,
                               .describe = describe,
                               .tabulate = tabulate,
                               .shade = shade,
                               .prepare = prepare,
                               .eval = eval,
                               .draw = draw,
                               .sample_delta = dielectric_sample_delta};
