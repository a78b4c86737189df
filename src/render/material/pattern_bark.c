// Furrowed bark like that of oaks and limes: long ridges that fork and join, deep dark furrows
// between them, shallow cracks across. Laid out in metres around and along the branch. Ridges have
// one size on all stems thicker than a hand; branches have finer ones, twigs a smooth skin. Other
// kinds of bark: pattern_bark_*.c.
#include "render/material/pattern_noise.h"
#include "render/material/pattern_stem.h"

// Height 0..1, its slope per metre around and along the stem, and inputs to the colour.
typedef struct BarkRelief {
    float height, slope_u, slope_v;
    float furrow; // 1 in the depth of a furrow
    float plate;  // 0..1, random per ridge
    float grain;  // about -1..1
} BarkRelief;

enum { LENGTHENING = 6 }; // of ridges along the branch

#define BARK_WIDTH 0.045f // m: of the ridges, by default
#define MINIATURE 0.02f   // m: ridges that are narrower are a miniature tree's, such as a bonsai's

// Of the branch, m, as that of a full-size tree: a miniature's bark is as old on thinner branches.
// 0 where it is unknown.
static float full_size_radius(const SurfacePoint *point, float width)
{
    return point->radius / fminf(1.0f, width / MINIATURE);
}

// The position in units of ridge widths, distorted so that ridges wind and have ragged edges.
static Vec3 ridge_lookup(const StemPlace *place, float width, Vec3 wind)
{
    Vec3 torn, p = vec3_scale(place->p, 1.0f / width);
    noise_solid(vec3(3.1f * p.x, 3.1f * p.y, 1.3f * p.z), 15, &torn);
    Vec3 q = vec3(p.x, p.y, p.z * (1.0f / LENGTHENING));
    q = vec3_madd(q, 0.42f, wind);
    return vec3_madd(q, 0.055f, torn);
}

static BarkRelief ridges(const StemPlace *place, float width, Vec3 wind, uint32_t seed)
{
    CellPoint cell = noise_cells(ridge_lookup(place, width, wind), seed);
    // Converts to true distances on the surface, in ridge widths: distances are compressed along
    // the branch, and borders cut the surface at a slant.
    float nu = vec3_dot(cell.normal, place->along_u), nv = cell.normal.z * (1.0f / LENGTHENING);
    float length = fmaxf(sqrtf(nu * nu + nv * nv), 0.15f), distance = cell.border / length;
    nu /= length;
    nv /= length;
    // Borders along the branch are furrows, borders across it cracks.
    float along = nu * nu;
    float depth = lerpf(0.45f, 1.0f, along);
    BarkRelief r = {.plate = noise_unit(cell.cell, 7)};
    float wall = lerpf(0.10f, 0.36f + 0.12f * wind.x, along);
    float floor_width = 0.22f * wall;
    float t = clampf((distance - floor_width) / (wall - floor_width), 0.0f, 1.0f);
    float rise = t * (2.0f - t);
    float slope = t > 0.0f && t < 1.0f ? 2.0f * (1.0f - t) / (wall - floor_width) : 0.0f;
    float top = 0.75f + 0.25f * r.plate;
    r.height = top * (1.0f - depth * (1.0f - rise));
    r.furrow = depth * (1.0f - rise);
    r.slope_u = top * depth * slope * nu / width;
    r.slope_v = top * depth * slope * nv / width;
    return r;
}

// Adds `height` of a noise with this slope at the place.
static void add_relief(BarkRelief *r, const StemPlace *place, float height, Vec3 slope)
{
    r->height += height;
    r->slope_u += vec3_dot(slope, place->along_u);
    r->slope_v += slope.z;
}

// A lookup stretched along the branch, different for every ridge.
static Vec3 grain_lookup(const BarkRelief *r, const StemPlace *place, float wavelength,
                         float lengthening)
{
    Vec3 p = vec3_scale(place->p, 1.0f / wavelength);
    return vec3(p.x, p.y, p.z / lengthening + 10.0f * r->plate);
}

// Thin cracks along the grain, where a stretched noise passes through zero.
static void add_fissures(BarkRelief *r, const StemPlace *place, float wavelength, float height)
{
    const float lengthening = 5.0f, width = 0.2f;
    Vec3 g;
    float n = noise_solid(grain_lookup(r, place, wavelength, lengthening), 12, &g);
    float inside = 1.0f - fabsf(n) / width;
    if (inside <= 0.0f) {
        return;
    }
    height *= 1.0f - r->furrow;
    float change = 2.0f * height * inside / width / wavelength * (n < 0.0f ? -1.0f : 1.0f);
    r->grain -= 1.3f * inside * inside;
    add_relief(r, place, -height * inside * inside,
               vec3(change * g.x, change * g.y, change * g.z / lengthening));
}

// Flakes: dents that are sharper than bulges.
static void add_flakes(BarkRelief *r, const StemPlace *place, float wavelength, float height)
{
    const float lengthening = 1.8f;
    Vec3 g;
    float n = noise_solid(grain_lookup(r, place, wavelength, lengthening), 16, &g);
    float dent = n < 0.0f ? 1.7f : 0.7f, scale = height * dent / wavelength;
    r->grain += dent * n;
    add_relief(r, place, height * dent * n,
               vec3(scale * g.x, scale * g.y, scale * g.z / lengthening));
}

static BarkRelief mix_relief(BarkRelief a, BarkRelief b, float t)
{
    return (BarkRelief){lerpf(a.height, b.height, t),   lerpf(a.slope_u, b.slope_u, t),
                        lerpf(a.slope_v, b.slope_v, t), lerpf(a.furrow, b.furrow, t),
                        lerpf(a.plate, b.plate, t),     lerpf(a.grain, b.grain, t)};
}

// The relief for the stem's size: coarse ridges, fine ones, or a blend between.
static BarkRelief relief_at(const SurfacePoint *point, const StemPlace *place, float width,
                            Vec3 wind)
{
    float radius = full_size_radius(point, width);
    float thick = radius > 0.0f ? smoothstepf(0.05f, 0.12f, radius) : 1.0f;
    float detail = pattern_detail(0.22f * width, point->footprint);
    BarkRelief coarse = {0}, fine = {0};
    if (thick > 0.0f) {
        coarse = ridges(place, width, wind, 11);
        add_fissures(&coarse, place, 0.55f * width, 0.3f);
        if (detail > 0.0f) {
            add_flakes(&coarse, place, 0.17f * width, 0.09f * detail);
            add_fissures(&coarse, place, 0.21f * width, 0.13f * detail);
        }
    }
    if (thick < 1.0f) {
        fine = ridges(place, 0.4f * width, wind, 13);
        add_flakes(&fine, place, 0.12f * width, 0.15f * detail);
    }
    return mix_relief(fine, coarse, thick);
}

// Pale patches of lichen on ridges; moss where it is shaded and damp: low, in furrows, on surfaces
// that face up and away from the sun (-z here).
static Vec3 add_growth(Vec3 color, const SurfacePoint *point, const BarkRelief *r, Vec3 wind)
{
    Vec3 n = surface_smooth_normal(point);
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
    float value = 0.86f + 0.3f * r->plate + 0.16f * wind.z + 0.2f * clampf(r->grain, -2.0f, 1.5f);
    Vec3 ridge = vec3_scale(own, value * (0.65f + 0.42f * clampf(r->height, 0.0f, 1.2f)));
    // Furrow walls show the warmer inner bark before they sink into the dark.
    float wall = 4.0f * r->furrow * (1.0f - r->furrow);
    ridge = vec3_mul(ridge, vec3(1.0f, 1.0f - 0.10f * wall, 1.0f - 0.22f * wall));
    Vec3 color = vec3_lerp(ridge, m->color2, smoothstepf(0.1f, 0.75f, r->furrow));
    return add_growth(color, point, r, wind);
}

// Young bark: smooth, lighter, with a breath of green.
static Vec3 twig_color(Vec3 color, Vec3 wind)
{
    Vec3 young = vec3(0.85f * color.x + 0.02f, 0.95f * color.y + 0.03f, 0.8f * color.z + 0.01f);
    return vec3_scale(young, 1.0f + 0.15f * wind.z);
}

static BarkLook look_at(const Material *m, const StemPlace *place, float scale, float footprint)
{
    switch (m->bark) {
    case BARK_PLATES:
        return bark_plates(m, place, scale, footprint);
    case BARK_BIRCH:
        return bark_birch(m, place, scale, footprint);
    case BARK_SMOOTH:
        return bark_smooth(m, place, scale, footprint);
    case BARK_FIBROUS:
        return bark_fibrous(m, place, scale, footprint);
    case BARK_FLAKES:
        return bark_flakes(m, place, scale, footprint);
    case BARK_SCALES:
        return bark_scales(m, place, scale, footprint);
    case BARK_CANES:
        return bark_canes(m, place, scale, footprint);
    case BARK_GNARLED:
        return bark_gnarled(m, place, scale, footprint);
    default:
        return bark_bands(m, place, scale, footprint);
    }
}

// pattern_scale of these is the size of features relative to nature's.
static BarkSurface other_bark(const Material *m, const SurfacePoint *point, const StemPlace *place)
{
    float scale = m->pattern_scale > 0.0f ? m->pattern_scale / BARK_WIDTH : 1.0f;
    BarkLook look = look_at(m, place, scale, point->footprint);
    float depth = m->pattern_depth * pattern_detail(1.6f * BARK_WIDTH * scale, point->footprint);
    return (BarkSurface){.color = vec3_max(look.color, vec3_splat(0.0f)),
                         .height = depth * (look.height - bark_mean_height(m->bark)),
                         .slope_u = depth * look.slope_u,
                         .slope_v = depth * look.slope_v};
}

static BarkSurface furrowed_bark(const Material *m, const SurfacePoint *point,
                                 const StemPlace *place, Vec3 own)
{
    float width = m->pattern_scale > 0.0f ? m->pattern_scale : BARK_WIDTH;
    Vec3 wind; // three smooth random numbers of the place
    Vec3 p = vec3_scale(point->object_position, 0.22f / width);
    noise_solid(vec3(1.3f * p.x, 0.9f * p.y, 1.3f * p.z), 10, &wind);
    wind = vec3_scale(wind, 0.6f);
    float radius = full_size_radius(point, width);
    float old = radius > 0.0f ? smoothstepf(0.008f, 0.03f, radius) : 1.0f;
    float seen = old * pattern_detail(1.6f * width, point->footprint);
    const BarkRelief flat = {.height = 0.7f,
                             .furrow = 0.3f}; // the mean of the relief, seen from afar
    Vec3 mean = add_growth(vec3_lerp(own, m->color2, 0.44f), point, &flat, wind);
    BarkSurface bark = {.color = mean};
    if (seen > 0.0f) {
        BarkRelief relief = relief_at(point, place, width, wind);
        float depth = seen * m->pattern_depth;
        bark =
            (BarkSurface){.color = vec3_lerp(mean, bark_color(m, point, &relief, wind, own), seen),
                          .height = depth * (relief.height - bark_mean_height(BARK_FURROWED)),
                          .slope_u = depth * relief.slope_u,
                          .slope_v = depth * relief.slope_v};
    }
    bark.color = vec3_lerp(twig_color(own, wind), bark.color, old);
    return bark;
}

// Where the bark is looked up. Kinds with marks that one knows again drift.
static StemPlace place_of(const Material *m, const SurfacePoint *point)
{
    StemPlace place = stem_place(point, m->twist);
    if (m->bark == BARK_PLATES || m->bark == BARK_BIRCH) {
        stem_drift(&place, point->object_position);
    }
    return place;
}

static BarkSurface bark_at(const Material *m, const SurfacePoint *point, const StemPlace *place,
                           Vec3 own)
{
    BarkSurface bark = m->bark == BARK_FURROWED ? furrowed_bark(m, point, place, own)
                                                : other_bark(m, point, place);
    // The lookup turns with the stem's twist: a step along it is one around it, too.
    bark.slope_v += place->twist * place->radius * bark.slope_u;
    bark_scars(m, point, place, &bark);
    bark_moss(m, point, place, &bark);
    return bark;
}

static Vec3 slope_of(const BarkSurface *bark, const StemPlace *place)
{
    return vec3_madd(vec3_scale(place->u, bark->slope_u), bark->slope_v, place->v);
}

void pattern_bark(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    StemPlace place = place_of(m, point);
    BarkSurface bark = bark_at(m, point, &place, shade->color);
    Vec3 slope = slope_of(&bark, &place), shown = slope;
    if (point->displaced > 0.0f && point->coarsening > 1.0f) {
        SurfacePoint coarse = pattern_coarse_point(point);
        BarkSurface of_geometry = bark_at(m, &coarse, &place, shade->color);
        shown = slope_of(&of_geometry, &place);
    }
    shade->color = bark.color;
    shade->normal = pattern_tilt(shade->normal, vec3_madd(slope, -point->displaced, shown));
}

float pattern_bark_height(const Material *m, const SurfacePoint *point)
{
    StemPlace place = place_of(m, point);
    // On thin branches bumps stand for the rest.
    float most = 0.25f * place.radius;
    BarkSurface bark = bark_at(m, point, &place, m->color);
    float share = m->pattern_depth > most ? most / m->pattern_depth : 1.0f;
    return share * bark.height + bark.form;
}
