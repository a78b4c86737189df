// Weathered wood: silver-grey fibres, dark where dirt and fungi have settled between them, rings of
// the end grain, knots and checks (mesh/wood.h).
#include "mesh/wood.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

enum { SEED_STREAK = 611, SEED_FIBRE = 613, SEED_STAIN = 617, SEED_RING = 619 };

static float scale_of(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 1.0f;
}

static Vec3 stretched(Vec3 p, float across, float along)
{
    return vec3(p.x / across, p.y / along, p.z / across);
}

static float height_at(const Material *m, const SurfacePoint *point, Vec3 p)
{
    float scale = scale_of(m), finest = fmaxf(0.0006f, 2.0f * point->footprint / scale);
    WoodPlace place = wood_place(vec3_scale(p, 1.0f / scale));
    const float whole = 0.003f; // m, from grooves to ridges
    return m->pattern_depth / whole *
           wood_grain_height(&place, wood_end(surface_smooth_normal(point)), finest);
}

// Share of color2 by the grain alone.
static float darkness(const WoodPlace *place, Vec3 p, float footprint)
{
    float streak = noise_fractal(stretched(place->grain, 0.012f, 0.5f), 2, SEED_STREAK);
    float fibre = noise_solid(stretched(place->grain, 0.0022f, 0.06f), SEED_FIBRE, NULL);
    float hair = noise_solid(stretched(place->grain, 0.0009f, 0.03f), SEED_FIBRE + 1, NULL);
    float stain = noise_fractal(stretched(p, 0.07f, 0.2f), 3, SEED_STAIN);
    return 0.3f + 0.35f * streak + 0.3f * stain +
           0.35f * fibre * pattern_detail(0.0022f, footprint) +
           0.3f * hair * pattern_detail(0.0009f, footprint);
}

// Late wood of the yearly rings, on an end; 0..1.
static float rings(const WoodPlace *place, Vec3 p, float footprint)
{
    const float year = 0.0026f; // m
    float wave = noise_fractal(vec3_scale(p, 45.0f), 3, SEED_RING);
    float t = place->radius / year + 2.2f * wave, late = t - floorf(t);
    return late * late * pattern_detail(year, footprint);
}

void pattern_wood(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = scale_of(m), footprint = point->footprint / scale;
    Vec3 p = vec3_scale(point->object_position, 1.0f / scale);
    WoodPlace place = wood_place(p);
    float end = wood_end(surface_smooth_normal(point));
    float dark = darkness(&place, p, footprint);
    dark = lerpf(dark, 0.45f + 0.3f * rings(&place, p, footprint), end);
    float heart = 0.5f + 0.5f * cosf(30.0f * place.knot);
    dark = lerpf(dark, 0.75f + 0.3f * heart, smoothstepf(0.0f, 0.35f, place.knot));
    Vec3 color = vec3_lerp(shade->color, m->color2, clampf(dark, 0.0f, 1.0f));
    Vec3 deep = vec3_scale(m->color2, 0.35f); // where rain does not reach, but dirt does
    shade->color = vec3_lerp(color, deep, 0.9f * smoothstepf(0.0f, 0.6f, place.check));
    if (m->pattern_depth > 0.0f) {
        shade->normal =
            pattern_tilt(shade->normal, pattern_slope(m, point, height_at, 0.00015f * scale));
    }
}
