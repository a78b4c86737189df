// Dunes: ripples across the wind that fork and fade, smooth slip faces with the tongues of
// avalanches, paler crests of finer grains, gravel on the plain between. SurfacePoint.site holds
// the wind over the place, the longer the deeper the sand (HeightField.wind).
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>

#define SECTOR 0.1745329252f // radians: ripples have one direction in a sector of the wind

typedef struct Relief {
    float height; // relative to the ripples' own
    Vec3 slope;   // per metre
} Relief;

// Ripples across one direction, in world space, so that they go on over the land's copies. Their
// crests wander and end.
static Relief ripples(const SurfacePoint *point, float angle, float wavelength, uint32_t seed)
{
    Vec3 p = vec3_scale(point->position, 1.0f / wavelength);
    float c = cosf(angle), s = sinf(angle), along = p.x * c + p.z * s, across = p.z * c - p.x * s;
    Vec3 bend, fork;
    float wander = noise_solid(vec3(0.045f * along, 0.0f, 0.03f * across), seed, &bend);
    float split = noise_solid(vec3(0.21f * along, 0.0f, 0.085f * across), seed + 1, &fork);
    float phase = 2.0f * PI_F * (along + 1.6f * wander + 0.42f * split);
    float up = 1.0f + 1.6f * 0.045f * bend.x + 0.42f * 0.21f * fork.x;
    float aside = 1.6f * 0.03f * bend.z + 0.42f * 0.085f * fork.z;
    // A gentle windward side and a steep lee.
    float height = sinf(phase) - 0.28f * sinf(2.0f * phase);
    float rise = 2.0f * PI_F / wavelength * (cosf(phase) - 0.56f * cosf(2.0f * phase));
    return (Relief){height, vec3(rise * (up * c - aside * s), 0.0f, rise * (up * s + aside * c))};
}

// Streaks down a slip face.
static Relief tongues(const SurfacePoint *point, float angle)
{
    Vec3 p = point->position, slope;
    float c = cosf(angle), s = sinf(angle), along = p.x * c + p.z * s, across = p.z * c - p.x * s;
    float value = noise_solid(vec3(0.07f * along, 0.0f, 0.55f * across), 211, &slope);
    float aside = 0.55f * slope.z;
    return (Relief){value, vec3(-aside * s, 0.0f, aside * c)};
}

static Relief mixed(Relief a, Relief b, float t)
{
    return (Relief){lerpf(a.height, b.height, t), vec3_lerp(a.slope, b.slope, t)};
}

void pattern_dunes(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float wavelength = m->pattern_scale > 0.0f ? m->pattern_scale : 0.16f;
    float wind_x = 2.0f * point->site.x - 1.0f, wind_z = 2.0f * point->site.y - 1.0f;
    float depth = sqrtf(wind_x * wind_x + wind_z * wind_z);
    float turn = atan2f(wind_z, wind_x) / SECTOR, sector = floorf(turn);
    float t = smoothstepf(0.25f, 0.75f, turn - sector);
    float low = SECTOR * sector, high = SECTOR * (sector + 1.0f);
    SurfacePoint place = *point; // noise goes on over copies, too
    place.object_position = point->position;
    float upright = fabsf(surface_smooth_normal(point).y);
    PatternOctaves broad = pattern_octaves(&place, 60.0f, 4, 0.55f, 1.0f, 201);
    PatternOctaves grain = pattern_octaves(&place, 0.012f, 2, 0.8f, 1.0f, 221);
    float face = smoothstepf(0.878f, 0.852f, upright + 0.006f * broad.value);
    float bare = 1.0f - smoothstepf(0.02f, 0.12f, depth + 0.03f * broad.value);
    Relief ripple =
        mixed(ripples(point, low, wavelength, 231), ripples(point, high, wavelength, 231), t);
    float seen = pattern_detail(wavelength, point->footprint) * (1.0f - face) * (1.0f - bare);
    seen *= smoothstepf(-1.1f, 0.1f, pattern_octaves(&place, 3.5f, 2, 0.6f, 1.0f, 241).value);
    Relief slide = mixed(tongues(point, low), tongues(point, high), t);
    float slid = face * pattern_detail(1.8f, point->footprint);
    float pale = smoothstepf(0.75f, 1.0f, depth);
    Vec3 sand = vec3_scale(shade->color, 0.90f + 0.16f * pale + 0.05f * broad.value);
    // Coarse, darker grains gather on the crests of ripples.
    sand = vec3_scale(sand, 1.0f - 0.07f * seen * ripple.height + 0.05f * slid * slide.height);
    sand = vec3_scale(sand, 1.0f + 0.10f * clampf(grain.value, -1.0f, 1.0f));
    PatternOctaves stones = pattern_octaves(&place, 0.25f, 5, 0.75f, 1.0f, 251);
    Vec3 plain = vec3_scale(m->color2, clampf(1.0f + 0.35f * stones.value, 0.5f, 1.5f));
    shade->color = vec3_lerp(sand, plain, bare);
    float amplitude = 0.5f * m->pattern_depth;
    Vec3 slope = vec3_scale(ripple.slope, amplitude * seen);
    slope = vec3_madd(slope, 5.0f * amplitude * slid, slide.slope);
    slope = vec3_madd(slope, 0.0006f, grain.slope);
    slope = vec3_madd(slope, 0.012f * bare, stones.slope);
    shade->normal = pattern_tilt(shade->normal, slope);
}
