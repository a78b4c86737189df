// The blade of a broad leaf: midrib and side veins by uv (u across with the midrib at 0.5, v
// along), paler than the blade between them; blotches; every leaf differs.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <stddef.h>

static const float blotch_share = 0.35f;  // weight of the second colour in the strongest blotch
static const float blotch_mean = 0.0127f; // of a blotch's strength over a blade

// 1 in the middle of a line, 0 from `width` away; widened to the footprint, and fainter then.
static float line(float distance, float width, float blur)
{
    float shown = width + blur;
    return width / shown * (1.0f - smoothstepf(0.3f * shown, shown, distance));
}

// Veins along the blade, as of grasses: fine, every fourth stronger.
static float veins_along(Vec2 uv, float blur)
{
    enum { VEINS = 24 };
    float run = uv.x * VEINS, number = floorf(run);
    float across = fabsf(run - number - 0.5f) / VEINS;
    float strong = number - 4.0f * floorf(0.25f * number) < 0.5f ? 1.0f : 0.5f;
    float midrib = line(fabsf(uv.x - 0.5f), lerpf(0.018f, 0.004f, uv.y), blur);
    return fmaxf(0.6f * strong * line(across, 0.006f, blur), 0.5f * midrib);
}

// Veinlets, seen from near: rungs across from side vein to side vein, and between them a net whose
// meshes are about as wide as long. run counts side veins along the blade, side is the distance
// from the midrib.
static float veinlets(float run, float side, float count, float blur)
{
    const float rungs = 3.4f, meshes = 7.0f; // by the distance of two side veins
    const float width = 0.65f;               // of a blade of the common sort, by its length
    float seen = 1.0f - smoothstepf(0.004f, 0.012f, blur);
    if (seen <= 0.0f) {
        return 0.0f;
    }
    float bend = noise_fractal(vec3(3.0f * run, 9.0f * side, 0.0f), 2, 47);
    float ladder = side * rungs * count + 0.8f * bend, rung = ladder - floorf(ladder);
    float first = line(fabsf(rung - 0.5f) / (rungs * count), 0.0035f, blur);
    Vec3 at = vec3(meshes * run, meshes * width * count * side, 0.5f);
    float border = noise_cells(at, 53).border;
    float second = line(border / (meshes * count), 0.0022f, blur);
    return seen * fmaxf(0.6f * first, 0.5f * second);
}

// Veins from the middle, uv (0.5, 0.5), to a rim about 0.5 away; each forks twice on its way.
static float veins_radial(Vec2 uv, float count, float blur)
{
    float x = uv.x - 0.5f, y = uv.y - 0.5f, r = sqrtf(x * x + y * y);
    float bend = noise_fractal(vec3(7.0f * uv.x, 7.0f * uv.y, 0.0f), 2, 67);
    float run = count * (atan2f(x, y) / (2.0f * PI_F) + 0.5f) + 0.16f * bend;
    float number = floorf(run), away = fabsf(run - number - 0.5f);
    float place = noise_unit((uint32_t)(int32_t)number, 71); // of the first fork
    float first = 0.25f * smoothstepf(lerpf(0.1f, 0.24f, place), 0.52f, r);
    float second = 0.1f * smoothstepf(lerpf(0.3f, 0.38f, place), 0.56f, r);
    float across = fabsf(fabsf(away - first) - second) * 2.0f * PI_F * r / count;
    float vein = line(across, lerpf(0.011f, 0.0035f, clampf(2.2f * r, 0.0f, 1.0f)), blur);
    float border = noise_cells(vec3(34.0f * uv.x, 34.0f * uv.y, 0.5f), 53).border;
    float net = line(border / 34.0f, 0.0022f, blur) * (1.0f - smoothstepf(0.004f, 0.012f, blur));
    return fmaxf(vein, fmaxf(0.35f * net, 1.0f - smoothstepf(0.012f, 0.03f, r)));
}

// Coverage of uv by a vein; count: side veins on each half.
static float veins(const Material *m, Vec2 uv, float blur)
{
    float count = m->veins;
    if (m->rays > 0.0f) {
        return veins_radial(uv, m->rays, blur);
    }
    if (count <= 0.0f) {
        return veins_along(uv, blur);
    }
    float side = fabsf(uv.x - 0.5f), left = uv.x < 0.5f ? 0.5f : 0.0f;
    float midrib = line(side, lerpf(0.022f, 0.006f, uv.y), blur);
    // Side veins leave the midrib alternately and curve toward the tip.
    float run = ((uv.y - 0.9f * side + 0.5f * side * side) * count) + left;
    float phase = run - floorf(run);
    float across = fabsf(phase - 0.5f) / count;
    float vein = line(across, lerpf(0.012f, 0.004f, clampf(2.2f * side, 0.0f, 1.0f)), blur);
    return fmaxf(fmaxf(midrib, 0.85f * vein), veinlets(run, side, count, blur));
}

// How far a blade is paler about its midrib (of a lobed one, those of all lobes) and its side
// veins: along the vein nearly white, beside it in a band that fades.
static float pale_band(const Material *m, Vec2 uv, float blur)
{
    if (m->rays > 0.0f) {
        return 0.8f * veins(m, uv, blur);
    }
    float side = fabsf(uv.x - 0.5f);
    float midrib = line(side, lerpf(0.045f, 0.012f, uv.y), blur);
    float band = 0.3f * (1.0f - smoothstepf(0.0f, lerpf(0.2f, 0.08f, uv.y), side));
    float fine = m->veins > 0.0f ? 0.3f * veins(m, uv, blur) : 0.0f;
    return fmaxf(fmaxf(0.8f * midrib, fine), band);
}

// Dead spots that insects and fungi leave: 1 inside, in a few places of some leaves. seed: of the
// leaf.
static float dead_spot(Vec2 uv, float seed, float blur)
{
    const float share = 0.02f; // of the cells that have one
    if (blur > 0.02f) {
        return 0.0f;
    }
    CellPoint c = noise_cells(vec3(6.0f * uv.x, 10.0f * uv.y, 1.7f * seed), 59);
    float pick = noise_unit(c.cell, 61), radius = lerpf(0.1f, 0.34f, pick / share);
    float away = sqrtf(c.point.x * c.point.x + c.point.y * c.point.y);
    return pick < share ? 1.0f - smoothstepf(0.75f * radius, radius, away) : 0.0f;
}

// Per channel: the factor of a blotch of this strength (0..1) on transmitted light, with mean about
// 1 over a blade. Blotches shift toward the second colour in transmission as in reflection.
static float blotch_filter(float color, float color2, float spot)
{
    float change = blotch_share * (clampf(color2 / fmaxf(color, 1e-3f), 0.0f, 4.0f) - 1.0f);
    return (1.0f + change * spot) / (1.0f + change * blotch_mean);
}

void pattern_leaf(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float length = vec3_length(point->tangent_v);
    float blur = length > 0.0f ? point->footprint / length : 0.0f;
    float seed = 31.0f * point->variation;
    Vec3 p = vec3(5.0f * point->uv.x, 7.0f * point->uv.y, seed);
    float blotch = noise_fractal(p, blur < 0.05f ? 3 : 1, 41);
    float vein = blur < 0.2f ? veins(m, point->uv, blur) : 0.0f;
    Vec3 own = shade->color;
    // Blotches shift toward the second colour if the material has a distinct one.
    float spot = smoothstepf(0.25f, 0.75f, blotch);
    Vec3 blade =
        vec3_lerp(vec3_scale(shade->color, 1.0f + 0.22f * blotch), m->color2, blotch_share * spot);
    // Seen from above, veins are little paler than the blade; against the light they are dark,
    // since they are thick, and yellower, since they hold less chlorophyll.
    Vec3 pale = vec3(1.3f * shade->color.x + 0.015f, 1.2f * shade->color.y + 0.015f,
                     1.2f * shade->color.z + 0.008f);
    shade->color = vec3_lerp(blade, pale, 0.8f * vein);
    if (m->pale_veins > 0.0f && blur < 0.2f) {
        float light = m->pale_veins * pale_band(m, point->uv, blur);
        shade->color = vec3_lerp(shade->color, vec3(0.30f, 0.36f, 0.20f), light);
    }
    float clear = 1.0f + 0.25f * blotch; // blotches thin or thicken the blade
    shade->transmittance = vec3_mul(
        shade->transmittance,
        vec3_scale(vec3(1.0f - 0.72f * vein, 1.0f - 0.82f * vein, 1.0f - 0.7f * vein), clear));
    Vec3 filter =
        vec3(blotch_filter(own.x, m->color2.x, spot), blotch_filter(own.y, m->color2.y, spot),
             blotch_filter(own.z, m->color2.z, spot));
    shade->transmittance = vec3_mul(shade->transmittance, filter);
    float dead = dead_spot(point->uv, seed, blur);
    shade->color = vec3_lerp(shade->color, vec3(0.13f, 0.078f, 0.035f), dead);
    shade->transmittance = vec3_mul(
        shade->transmittance, vec3(1.0f - 0.45f * dead, 1.0f - 0.8f * dead, 1.0f - 0.7f * dead));
    if (m->pattern_depth > 0.0f && blur < 0.05f && length > 0.0f) {
        const float h = 0.004f;
        float du = veins(m, (Vec2){point->uv.x + h, point->uv.y}, blur) - vein;
        float dv = veins(m, (Vec2){point->uv.x, point->uv.y + h}, blur) - vein;
        float width = vec3_length(point->tangent_u);
        Vec3 u = vec3_scale(point->tangent_u, width > 0.0f ? 1.0f / (width * width) : 0.0f);
        Vec3 v = vec3_scale(point->tangent_v, 1.0f / (length * length));
        Vec3 slope = vec3_madd(vec3_scale(u, du / h), dv / h, v);
        shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, m->pattern_depth));
    }
}
