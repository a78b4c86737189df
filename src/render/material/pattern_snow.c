// Settled snow: soft hummocks over what lies below, ripples of a wind that has passed in places,
// sastrugi that it has cut, pits with crumbs where clods fell from trees, tracks of a fox, grains.
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"
#include "render/material/pattern_ripples.h"

#include <math.h>
#include <stddef.h>

// Features relative to the length of the largest hummocks; heights relative to pattern_depth.
#define RIPPLE_LENGTH 0.14f
#define RIPPLE_HEIGHT 0.035f
#define WIND_X 0.83f // where the wind blows to
#define WIND_Z 0.56f
#define RIDGE_LENGTH 1.1f // of sastrugi, along the wind
#define RIDGE_WIDTH 0.3f
#define RIDGE_HEIGHT 0.42f
#define PIT_LENGTH 0.55f // mean distance of what might be a pit
#define PIT_DEPTH 0.34f
#define PIT_SHARE 0.3f // of the places
#define CRUMB_LENGTH 0.04f
#define CRUMB_HEIGHT 0.14f

// Tracks, m: from one to the next beside it, from print to print, how far they wind.
#define TRACK_SPACING 11.0f
#define TRACK_ASIDE 2.2f // of the first, from the origin
#define STEP 0.37f
#define DRAG 0.021f // depth of the furrows that the feet draw before and behind a print
#define WINDING 1.6f
#define WINDING_LENGTH 7.0f

enum {
    SEED_HUMMOCKS = 401,
    SEED_PATCHES = 411,
    SEED_RIPPLES = 421,
    SEED_PITS = 431,
    SEED_CRUMBS = 441,
    SEED_GRAINS = 451,
    SEED_TRACKS = 461,
    SEED_RIDGES = 471
};

static float length_of(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 1.8f;
}

// Rounded bodies, higher than their valleys are narrow: snow fills hollows.
static float hummocks(Vec3 p)
{
    float large = noise_solid(p, SEED_HUMMOCKS, NULL);
    float middle = noise_solid(vec3_scale(p, 2.3f), SEED_HUMMOCKS + 1, NULL);
    float small = noise_solid(vec3_scale(p, 5.1f), SEED_HUMMOCKS + 2, NULL);
    return 0.62f * large + 0.24f * middle * (1.0f + large) + 0.06f * small;
}

// Sastrugi, 0 .. 1: what the wind has left of two crusts, tongues along it whose edges are sharp
// against it and beside it and fade out in the lee.
static float ridges(Vec3 p)
{
    const float edge[2] = {-0.12f, 0.2f};
    float along = WIND_X * p.x + WIND_Z * p.z, across = WIND_X * p.z - WIND_Z * p.x;
    float bend = 0.3f * noise_solid(vec3_scale(p, 0.7f), SEED_RIDGES + 1, NULL);
    float fray = 0.06f * noise_solid(vec3_scale(p, 6.0f), SEED_RIDGES + 2, NULL);
    Vec3 slope, q = vec3(along / RIDGE_LENGTH, 0.0f, (across + bend) / RIDGE_WIDTH);
    float crust = noise_solid(q, SEED_RIDGES, &slope), height = 0.0f;
    float width = lerpf(0.34f, 0.045f, smoothstepf(-0.5f, 0.6f, slope.x));
    for (int k = 0; k < 2; k++) {
        height += 0.5f * smoothstepf(edge[k] - width, edge[k] + width, crust + fray);
    }
    return height;
}

// A hole with a raised, uneven rim; *near: 1 about it, where crumbs lie.
static float pit(Vec3 p, float *near)
{
    Vec3 q = vec3_scale(vec3(p.x, 0.0f, p.z), 1.0f / PIT_LENGTH);
    CellPoint cell = noise_cells_on(q, vec3(0, 1, 0), SEED_PITS);
    *near = 0.0f;
    if (noise_unit(cell.cell, 1) > PIT_SHARE) {
        return 0.0f;
    }
    float u = noise_unit(cell.cell, 2), radius = lerpf(0.06f, 0.2f, u * u);
    float wave = 0.3f * noise_solid(vec3_scale(q, 5.0f), SEED_PITS + 1, NULL);
    float x = cell.point.x / radius, z = cell.point.z / radius;
    float away = sqrtf(x * x + z * z) * (1.0f + wave) + wave;
    float inner = 1.0f - smoothstepf(0.45f, 1.0f, away);
    float rim = smoothstepf(0.6f, 1.05f, away) * (1.0f - smoothstepf(1.05f, 1.7f, away));
    float own = smoothstepf(0.0f, 0.12f, cell.border); // ends at the next one's border
    *near = own * (1.0f - smoothstepf(1.0f, 2.4f, away));
    return own * radius * 4.0f * (0.3f * rim - inner);
}

static float crumbs(Vec3 p, float near)
{
    if (near <= 0.0f) {
        return 0.0f;
    }
    Vec3 q = vec3_scale(p, 1.0f / CRUMB_LENGTH);
    CellPoint cell = noise_cells_on(vec3(q.x, 0.0f, q.z), vec3(0, 1, 0), SEED_CRUMBS);
    float u = noise_unit(cell.cell, 1), radius = 0.5f * u;
    float square = cell.point.x * cell.point.x + cell.point.z * cell.point.z;
    float there = smoothstepf(0.0f, 0.15f, 0.6f * near - noise_unit(cell.cell, 2)) *
                  smoothstepf(0.0f, 0.15f, cell.border);
    return square < radius * radius ? there * u * (1.0f - square / (radius * radius)) : 0.0f;
}

// Where track `number` is beside its line at the way `t` along it, m.
static float track_at(float t, float number)
{
    Vec3 p = vec3(t / WINDING_LENGTH, 0.5f, 7.3f * number);
    return TRACK_SPACING * number + TRACK_ASIDE + WINDING * noise_solid(p, SEED_TRACKS, NULL);
}

// How deep the feet have drawn through the snow `t` m before the middle of a print, `across` m
// beside it: shallow furrows that run out, the longer one where they were lifted.
static float furrow(float t, float across, float part)
{
    float reach = t > 0.0f ? 0.2f : 0.13f, along = 1.0f - fabsf(t) / (reach * (0.6f + 0.4f * part));
    float beside = 1.0f - fabsf(across) / 0.022f;
    return along > 0.0f && beside > 0.0f ? along * smoothstepf(0.0f, 0.8f, beside) : 0.0f;
}

// A fox sets its hind feet into the prints of its fore feet, nearly in one line; the snow falls in
// at their ragged edges, and some is thrown ahead. m, at p (m); share: of the tracks that there
// are.
static float print(Vec3 p, float share)
{
    const float turn_c = 0.27f, turn_s = 0.963f; // of the tracks' direction
    float t = turn_c * p.x + turn_s * p.z, across = turn_s * p.x - turn_c * p.z;
    float number = floorf((across - TRACK_ASIDE) / TRACK_SPACING + 0.5f),
          step = floorf(t / STEP + 0.5f);
    uint32_t hash = noise_square((int)step, (int)number, SEED_TRACKS);
    if (noise_unit(noise_square(7, (int)number, SEED_TRACKS), 0) >= share) {
        return 0.0f;
    }
    float middle = STEP * (step + 0.16f * (noise_unit(hash, 1) - 0.5f));
    float side = fmodf(fabsf(step), 2.0f) < 0.5f ? 0.035f : -0.035f;
    float ahead = middle - t, aside = across - track_at(middle, number) - side; // it runs to -t
    float x = ahead / (0.042f + 0.016f * noise_unit(hash, 2)), z = aside / 0.036f;
    float ragged = noise_solid(vec3_scale(p, 22.0f), SEED_TRACKS, NULL) +
                   0.3f * noise_solid(vec3_scale(p, 47.0f), SEED_TRACKS + 1, NULL);
    float away = sqrtf(x * x + z * z) * (1.0f - 0.12f * x) + 0.4f * ragged;
    float inner = 1.0f - smoothstepf(0.4f, 1.25f, away);
    float rim = smoothstepf(0.8f, 1.2f, away) * (1.0f - smoothstepf(1.2f, 2.0f, away));
    float thrown = smoothstepf(0.9f, 1.6f, x) * (1.0f - smoothstepf(2.2f, 4.0f, away));
    float clods = fmaxf(0.0f, ragged) * thrown;
    return 0.006f * rim + 0.018f * clods - lerpf(0.06f, 0.1f, noise_unit(hash, 3)) * inner -
           DRAG * (1.0f - inner) * furrow(ahead, aside + 0.008f * ragged, noise_unit(hash, 4));
}

// Height at p (m, of the object), m.
static float relief_at(const Material *m, const SurfacePoint *point, Vec3 place)
{
    float length = length_of(m), near;
    Vec3 p = vec3_scale(vec3(place.x, 0.0f, place.z), 1.0f / length);
    float height = hummocks(p);
    float patch = noise_solid(vec3_scale(p, 0.45f), SEED_PATCHES, NULL);
    float blown = smoothstepf(-0.15f, 0.35f, patch) *
                  pattern_detail(RIPPLE_LENGTH * length, point->footprint);
    if (blown > 0.0f) {
        SandRelief r = pattern_ripples(p, WIND_X, WIND_Z, RIPPLE_LENGTH, SEED_RIPPLES);
        height += RIPPLE_HEIGHT * blown * r.height;
    }
    if (m->ribs > 0.0f) {
        float cut = m->ribs * smoothstepf(-0.7f, 0.0f, patch);
        height += RIDGE_HEIGHT * cut * (ridges(p) - 0.5f);
    }
    if (pattern_detail(0.1f * length, point->footprint) > 0.0f) {
        height += PIT_DEPTH * pit(p, &near);
        height += CRUMB_HEIGHT * crumbs(p, near) *
                  pattern_detail(CRUMB_LENGTH * length, point->footprint);
    }
    height *= 0.5f * m->pattern_depth;
    return height + print(place, m->scars) * pattern_detail(0.1f, point->footprint);
}

float pattern_snow_height(const Material *m, const SurfacePoint *point)
{
    return relief_at(m, point, point->object_position);
}

void pattern_snow(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    PatternOctaves grain = pattern_octaves(point, 0.02f, 4, 0.8f, 1.0f, SEED_GRAINS);
    shade->color =
        vec3_lerp(shade->color, m->color2, clampf(0.4f + 0.4f * grain.value, 0.0f, 1.0f));
    Vec3 slope = vec3_scale(grain.slope, 0.0009f);
    if (m->pattern_depth > 0.0f) {
        slope = vec3_add(slope, pattern_bump(m, point, relief_at, 0.004f * length_of(m)));
    }
    shade->normal = pattern_tilt(shade->normal, slope);
}
