// Dunes: ripples across the wind of three sizes, which sand that falls behind a brink buries, slip
// faces with grain flows, paler crests of finer grains, gravel on the plain between.
// SurfacePoint.site holds the wind over the place, the longer the deeper the sand
// (HeightField.wind).
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_ripples.h"

#include <math.h>

enum { SIZES = 3 };

// Ripples, ridges of coarser grains and small dunes on the back of large ones: each fades where a
// pixel no longer shows it, and the next goes on.
static const struct {
    float length, height; // relative to those of the ripples
    float patch;          // m: they come and go over this length
    float common;         // the larger, the more ground they cover
} SIZE[SIZES] = {
    {1.0f, 1.0f, 5.0f, 0.45f}, {11.0f, 4.0f, 24.0f, -0.1f}, {85.0f, 5.0f, 110.0f, -0.3f}};

typedef struct Relief {
    float height; // of the ripples alone, times how much of them is seen
    Vec3 slope;   // of all, per unit of the ripples' own height
} Relief;

// The wind over a place, and how far it turns down the slope, as ripples on a dune's flanks do.
static Relief ripples(const Material *m, const SurfacePoint *point, float wind_x, float wind_z)
{
    float wavelength = m->pattern_scale > 0.0f ? m->pattern_scale : 0.12f;
    Vec3 up = surface_smooth_normal(point);
    float x = wind_x + 0.8f * up.x, z = wind_z + 0.8f * up.z, size = sqrtf(x * x + z * z);
    SurfacePoint place = *point; // noise goes on over copies, too
    place.object_position = point->position;
    Relief sum = {0};
    // Behind a brink the ground falls toward where the wind blows, and grains fall out of it.
    float lee = (wind_x * up.x + wind_z * up.z) / fmaxf(fabsf(up.y), 0.1f);
    float calm = 1.0f - smoothstepf(0.1f, 0.4f, up.y < 0.0f ? -lee : lee);
    for (int i = 0; i < SIZES && size > 0.0f; i++) {
        float length = wavelength * SIZE[i].length;
        float seen = calm * pattern_detail(length, point->footprint);
        if (seen > 0.0f) {
            float n =
                pattern_octaves(&place, SIZE[i].patch, 2, 0.6f, 1.0f, 241 + 4u * (uint32_t)i).value;
            seen *= smoothstepf(-0.6f, 0.6f, n + SIZE[i].common);
        }
        if (seen > 0.0f) {
            SandRelief r = pattern_ripples(point->position, x / size, z / size, length,
                                           231 + 3u * (uint32_t)i);
            sum.height += i == 0 ? seen * r.height : 0.0f;
            sum.slope = vec3_madd(sum.slope, seen * SIZE[i].height, r.slope);
        }
    }
    return sum;
}

// What has slid down a slip face.
static SandRelief slides(const SurfacePoint *point)
{
    const float length = 9.0f; // m
    Vec3 up = surface_smooth_normal(point);
    float size = sqrtf(up.x * up.x + up.z * up.z);
    float seen = pattern_detail(0.05f * length, point->footprint);
    if (size < 0.1f || seen <= 0.0f) {
        return (SandRelief){0};
    }
    float turn = up.y < 0.0f ? -1.0f / size : 1.0f / size;
    SandRelief r = pattern_tongues(point->position, turn * up.x, turn * up.z, length, 211);
    return (SandRelief){seen * r.height, vec3_scale(r.slope, seen), seen * r.tone};
}

void pattern_dunes(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    const float thick = 0.05f; // m: of a tongue
    float wind_x = 2.0f * point->site.x - 1.0f, wind_z = 2.0f * point->site.y - 1.0f;
    float depth = sqrtf(wind_x * wind_x + wind_z * wind_z);
    SurfacePoint place = *point;
    place.object_position = point->position;
    float upright = fabsf(surface_smooth_normal(point).y);
    PatternOctaves broad = pattern_octaves(&place, 60.0f, 4, 0.55f, 1.0f, 201);
    PatternOctaves grain = pattern_octaves(&place, 0.03f, 4, 0.85f, 1.0f, 221);
    float face = smoothstepf(0.878f, 0.852f, upright + 0.006f * broad.value);
    float bare = 1.0f - smoothstepf(0.02f, 0.12f, depth + 0.03f * broad.value);
    Relief ripple = {0};
    if (face < 1.0f && bare < 1.0f) {
        ripple = ripples(m, point, wind_x / fmaxf(depth, 1e-3f), wind_z / fmaxf(depth, 1e-3f));
    }
    SandRelief slide = {0};
    if (face > 0.0f) {
        slide = slides(point);
    }
    float blown = (1.0f - face) * (1.0f - bare), pale = smoothstepf(0.75f, 1.0f, depth);
    Vec3 sand = vec3_scale(shade->color, 0.90f + 0.16f * pale + 0.05f * broad.value);
    // Coarse, darker grains gather on the crests of ripples; the coarse toes of flows look paler.
    sand = vec3_scale(sand, 1.0f - 0.09f * blown * ripple.height + 0.18f * face * slide.tone);
    sand = vec3_scale(sand, 1.0f + 0.16f * clampf(grain.value, -1.5f, 1.5f));
    PatternOctaves stones = pattern_octaves(&place, 0.25f, 5, 0.75f, 1.0f, 251);
    Vec3 plain = vec3_scale(m->color2, clampf(1.0f + 0.35f * stones.value, 0.5f, 1.5f));
    shade->color = vec3_lerp(sand, plain, bare);
    Vec3 slope = vec3_scale(ripple.slope, 0.5f * m->pattern_depth * blown);
    slope = vec3_madd(slope, thick * face, slide.slope);
    slope = vec3_madd(slope, 0.0012f, grain.slope);
    slope = vec3_madd(slope, 0.012f * bare, stones.slope);
    shade->normal = pattern_tilt(shade->normal, slope);
}
