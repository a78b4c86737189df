// Furrowed bark, as oaks and limes wear it: long ridges that fork and meet again, deep dark furrows
// between them, shallow cracks across. Laid out in metres around and along the branch. Ridges are
// of one size on all stems thicker than a hand; branches wear finer ones, twigs a smooth skin.
#include "render/pattern.h"
#include "render/pattern_noise.h"

#include <stddef.h>

typedef struct BarkPlace {
    float around, along; // m
    Vec3 u, v;           // world: unit directions in which these grow
} BarkPlace;

// Where there is no branch (imported meshes) bark runs up the object's y axis.
static BarkPlace bark_place(const SurfacePoint *point)
{
    float u = vec3_length(point->tangent_u), v = vec3_length(point->tangent_v);
    if (point->radius > 0.0f && u > 0.0f && v > 0.0f) {
        return (BarkPlace){point->uv.x, point->uv.y, vec3_scale(point->tangent_u, 1.0f / u),
                           vec3_scale(point->tangent_v, 1.0f / v)};
    }
    Vec3 p = point->object_position;
    bool facing_x = fabsf(point->geometric_normal.x) > fabsf(point->geometric_normal.z);
    return (BarkPlace){facing_x ? p.z : p.x, p.y, facing_x ? vec3(0, 0, 1) : vec3(1, 0, 0),
                       vec3(0, 1, 0)};
}

// Height 0..1 and its slope per metre around and along, and what colours it.
typedef struct BarkRelief {
    float height, slope_u, slope_v;
    float furrow; // 1 in the depth of a furrow
    float plate;  // 0..1, random per ridge
} BarkRelief;

enum { LENGTHENING = 5 }; // of ridges along the branch

// warp: moves the lookup sideways (in ridge widths), so that ridges wind.
static BarkRelief ridges(const BarkPlace *place, float width, Vec2 warp, uint32_t seed)
{
    const float stretch = 1.0f / LENGTHENING;
    float x = place->around / width + warp.x, y = place->along * stretch / width + warp.y;
    CellPoint cell = noise_cells(x, y, seed);
    // Distances are compressed along the branch: back to true ones, in ridge widths.
    float nx = cell.normal.x, ny = cell.normal.y * stretch;
    float length = sqrtf(nx * nx + ny * ny), distance = cell.border / length;
    nx /= length;
    ny /= length;
    // Borders that run along the branch are furrows, those across it mere cracks.
    float along = nx * nx;
    float depth = lerpf(0.35f, 1.0f, along);
    float wall = lerpf(0.12f, 0.34f, along);
    float t = clampf(distance / wall, 0.0f, 1.0f);
    float rise = t * (2.0f - t), slope = t < 1.0f ? 2.0f * (1.0f - t) / wall : 0.0f;
    BarkRelief r = {.plate = noise_unit(cell.cell, 7)};
    float top = 0.8f + 0.2f * r.plate;
    r.height = top * (1.0f - depth * (1.0f - rise));
    r.furrow = depth * (1.0f - rise);
    r.slope_u = top * depth * slope * nx / width;
    r.slope_v = top * depth * slope * ny / width;
    return r;
}

// Adds fissures along the grain and flakes: noise, drawn out along the branch.
static void add_grain(BarkRelief *r, const BarkPlace *place, float wavelength, float lengthening,
                      float height, uint32_t seed)
{
    float z = 10.0f * r->plate; // every ridge has its own grain
    Vec3 p = vec3(place->around / wavelength, place->along / (wavelength * lengthening), z), g;
    float n = noise_solid(p, seed, &g);
    r->height += height * n;
    r->slope_u += height * g.x / wavelength;
    r->slope_v += height * g.y / (wavelength * lengthening);
}

static BarkRelief mix_relief(BarkRelief a, BarkRelief b, float t)
{
    return (BarkRelief){lerpf(a.height, b.height, t), lerpf(a.slope_u, b.slope_u, t),
                        lerpf(a.slope_v, b.slope_v, t), lerpf(a.furrow, b.furrow, t),
                        t < 0.5f ? a.plate : b.plate};
}

// The relief at a stem's own size: coarse ridges, fine ones, or a blend where a stem thins out.
static BarkRelief relief_at(const SurfacePoint *point, const BarkPlace *place, float width,
                            Vec3 wind)
{
    float thick = point->radius > 0.0f ? smoothstepf(0.05f, 0.12f, point->radius) : 1.0f;
    Vec2 warp = {0.55f * wind.x, 0.25f * wind.y};
    BarkRelief coarse = {0}, fine = {0};
    if (thick > 0.0f) {
        coarse = ridges(place, width, warp, 11);
        add_grain(&coarse, place, 0.28f * width, 5.0f, 0.16f, 12);
    }
    if (thick < 1.0f) {
        fine = ridges(place, 0.4f * width, warp, 13);
        add_grain(&fine, place, 0.12f * width, 4.0f, 0.12f, 14);
    }
    return mix_relief(fine, coarse, thick);
}

// Lichen on ridges in pale patches, moss where it is shaded and damp: low, in furrows, on what
// faces up and away from the sun (-z here).
static Vec3 add_growth(Vec3 color, const SurfacePoint *point, const BarkRelief *r, Vec3 wind)
{
    Vec3 n = point->geometric_normal;
    float patch = 0.5f * wind.z + 0.5f * wind.x;
    float lichen = smoothstepf(0.12f, 0.45f, patch) * (1.0f - r->furrow);
    float grey = 0.35f * (color.x + color.y + color.z) + 0.02f;
    color = vec3_lerp(color, vec3(grey * 0.98f, grey * 1.06f, grey * 0.86f), 0.55f * lichen);
    float face = clampf(0.35f - 0.45f * n.z + 0.6f * n.y, 0.0f, 1.0f);
    float moss = face * smoothstepf(0.05f, 0.5f, 0.6f * wind.y - 0.5f * wind.x + 0.25f * r->furrow);
    return vec3_lerp(color, vec3(0.075f, 0.095f, 0.028f), 0.6f * moss);
}

static Vec3 bark_color(const Material *m, const SurfacePoint *point, const BarkRelief *r, Vec3 wind,
                       Vec3 own)
{
    float value = 0.82f + 0.36f * r->plate + 0.14f * wind.z;
    Vec3 ridge = vec3_scale(own, value * (0.72f + 0.38f * clampf(r->height, 0.0f, 1.1f)));
    // Furrow walls show the warmer inner bark before they sink into the dark.
    float wall = 4.0f * r->furrow * (1.0f - r->furrow);
    ridge = vec3_mul(ridge, vec3(1.0f, 1.0f - 0.10f * wall, 1.0f - 0.22f * wall));
    Vec3 color = vec3_lerp(ridge, m->color2, smoothstepf(0.15f, 0.9f, r->furrow));
    return add_growth(color, point, r, wind);
}

// Young bark: smooth, lighter, with a breath of green.
static Vec3 twig_color(Vec3 color, Vec3 wind)
{
    Vec3 young = vec3(0.85f * color.x + 0.02f, 0.95f * color.y + 0.03f, 0.8f * color.z + 0.01f);
    return vec3_scale(young, 1.0f + 0.15f * wind.z);
}

void pattern_bark(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float width = m->pattern_scale > 0.0f ? m->pattern_scale : 0.045f;
    Vec3 wind; // three smooth random numbers of the place
    Vec3 p = vec3_scale(point->object_position, 0.22f / width);
    noise_solid(vec3(1.3f * p.x, 0.9f * p.y, 1.3f * p.z), 10, &wind);
    wind = vec3_scale(wind, 0.6f);
    float old = point->radius > 0.0f ? smoothstepf(0.008f, 0.03f, point->radius) : 1.0f;
    float seen = old * pattern_detail(1.6f * width, point->footprint);
    Vec3 mean = vec3_lerp(shade->color, m->color2, 0.25f);
    Vec3 color = mean;
    if (seen > 0.0f) {
        BarkPlace place = bark_place(point);
        BarkRelief relief = relief_at(point, &place, width, wind);
        color = vec3_lerp(mean, bark_color(m, point, &relief, wind, shade->color), seen);
        Vec3 slope = vec3_madd(vec3_scale(place.u, relief.slope_u), relief.slope_v, place.v);
        shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, seen * m->pattern_depth));
    }
    shade->color = vec3_lerp(twig_color(shade->color, wind), color, old);
}
