// Weathered stone. Its relief is broken along planes of three sizes: cells of space (Worley 1996),
// each cut by a plane of its own, with joints between the largest. On it grains of minerals,
// stains below joints, lichen, and moss where it is level and low.
#include "render/material/overgrowth.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

enum {
    SIZES = 3,
    SEED_WARP = 201,
    SEED_CELLS = 210,
    SEED_GRAIN = 220,
    SEED_STAIN = 224,
    SEED_MOSS = 240
};

typedef struct Broken {
    float height; // about -0.5 .. 0.5
    float joint;  // 0..1: depth in a joint
} Broken;

static float scale_of(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 0.6f;
}

// Height of the plane that cuts the cell: through its point, facing a direction of its own.
static float plane_height(const CellPoint *cell)
{
    Vec3 facing = vec3(noise_unit(cell->cell, 11) - 0.5f, noise_unit(cell->cell, 12) - 0.5f,
                       noise_unit(cell->cell, 13) - 0.5f);
    return noise_unit(cell->cell, 14) - 0.5f - 1.4f * vec3_dot(facing, cell->point);
}

// p: m, in the object's space.
static Broken broken_at(Vec3 p, float scale, float footprint)
{
    Broken broken = {0};
    float amplitude = 0.55f, warp = 0.09f * scale;
    Vec3 aside = {noise_solid(vec3_scale(p, 2.1f / scale), SEED_WARP, NULL),
                  noise_solid(vec3_scale(p, 2.1f / scale), SEED_WARP + 1, NULL),
                  noise_solid(vec3_scale(p, 2.1f / scale), SEED_WARP + 2, NULL)};
    p = vec3_madd(p, warp, aside);
    for (uint32_t i = 0; i < SIZES; i++) {
        float seen = pattern_detail(scale, footprint);
        if (seen <= 0.0f) {
            break;
        }
        // Wider than high: stone parts more easily along its bed.
        CellPoint cell =
            noise_cells(vec3(p.x / scale, 1.7f * p.y / scale, p.z / scale), SEED_CELLS + i);
        float inside = smoothstepf(0.0f, 0.05f, cell.border);
        float open = i == 0 && noise_unit(cell.cell ^ cell.next, 15) > 0.55f;
        float joint = open * (1.0f - smoothstepf(0.0f, 0.05f, cell.border));
        broken.height += seen * amplitude * (inside * plane_height(&cell) - 0.5f * joint);
        broken.joint = fmaxf(broken.joint, seen * joint);
        scale *= 0.36f;
        amplitude *= 0.42f;
    }
    return broken;
}

// Fine roughness of the grain, as a share of the pattern's depth.
static float grain_height(Vec3 p, float footprint)
{
    const float size = 0.06f; // m, of its coarsest octave
    float seen = pattern_detail(0.5f * size, footprint);
    return seen > 0.0f ? 0.1f * seen * noise_fractal(vec3_scale(p, 1.0f / size), 5, SEED_GRAIN)
                       : 0.0f;
}

static float relief_at(const Material *m, const SurfacePoint *point, Vec3 p)
{
    float footprint = point->footprint;
    return m->pattern_depth *
           (broken_at(p, scale_of(m), footprint).height + grain_height(p, footprint));
}

// Of cushions of moss, m: their mean width, and their thickness where it grows best.
#define CUSHION 0.11f
#define THICKEST 0.022f

// Moss grows in a mat of cushions that are ragged at the rims of faces, hang over some of them, and
// have died or never grown elsewhere.
static Overgrowth moss_of(const Material *m, const SurfacePoint *point, Vec3 p, float joint)
{
    SurfacePoint at = *point;
    at.object_position = p;
    Vec3 n = surface_smooth_normal(point);
    float broad = noise_fractal(vec3_scale(p, 1.0f / 0.7f), 3, SEED_MOSS);
    float rim = noise_fractal(vec3(p.x / 0.24f, 0.6f * p.y / 0.24f, p.z / 0.24f), 4, SEED_MOSS + 4);
    float damp = 0.05f + 0.8f * (n.y + 0.45f * rim) - 0.2f * n.z - 0.35f * fmaxf(broad, 0.0f);
    Overgrowth moss = moss_at(m->moss, &at, clampf(damp, 0.0f, 1.0f), 1.5f * joint, THICKEST);
    if (moss.share <= 0.0f) {
        return moss;
    }
    float seen = pattern_detail(0.5f * CUSHION, point->footprint);
    float cushion = seen * noise_fractal(vec3_scale(p, 1.0f / CUSHION), 3, SEED_MOSS + 9);
    moss.height += 0.9f * THICKEST * moss.share * cushion;
    // Dry and dead moss is brown, young tips are yellow, and between cushions it is dark.
    float dry = smoothstepf(0.0f, 0.5f, broad + 0.5f * rim - 0.25f * cushion);
    Vec3 straw = vec3_scale(vec3(0.105f, 0.082f, 0.034f), 0.7f + moss.color.y * 3.0f);
    moss.color = vec3_lerp(moss.color, straw, 0.55f * dry);
    moss.color = vec3_scale(moss.color, clampf(0.68f + 0.6f * cushion, 0.28f, 1.2f));
    return moss;
}

// The same with its moss. A mat hides the finest of the relief below.
static float mossy_relief_at(const Material *m, const SurfacePoint *point, Vec3 p)
{
    Broken broken = broken_at(p, scale_of(m), point->footprint);
    float stone = m->pattern_depth * (broken.height + grain_height(p, point->footprint));
    Overgrowth moss = moss_of(m, point, p, broken.joint);
    return (1.0f - 0.7f * moss.share) * stone + moss.height;
}

float pattern_stone_height(const Material *m, const SurfacePoint *point)
{
    Vec3 p = point->object_position;
    Broken broken = broken_at(p, scale_of(m), point->footprint);
    float height = m->pattern_depth * (broken.height + grain_height(p, point->footprint));
    height += m->moss > 0.0f ? moss_of(m, point, p, broken.joint).height : 0.0f;
    return m->lichen > 0.0f ? height + lichen_at(m->lichen, point).height : height;
}

// Tone of the surface, mean about 1: streaks in which pressure has gathered dark mica, weathered
// spots of all sizes, and on the closest view grains of dark mica, grey quartz and pale feldspar.
static float grain_tone(const SurfacePoint *point)
{
    const float grain = 0.0036f, streak = 0.16f; // m
    PatternOctaves spots = pattern_octaves(point, streak, 8, 0.84f, 1.7f, SEED_GRAIN + 12);
    float tone = 1.0f + 0.19f * clampf(spots.value, -2.0f, 2.0f);
    float seen = pattern_detail(grain, point->footprint);
    if (seen <= 0.0f) {
        return tone;
    }
    Vec3 p = point->object_position;
    CellPoint cell =
        noise_cells(vec3(p.x / grain, 1.7f * p.y / grain, p.z / grain), SEED_GRAIN + 3);
    float kind = noise_unit(cell.cell, 21) + 0.06f * spots.value, own = noise_unit(cell.cell, 22);
    float mineral = kind < 0.12f ? 0.45f + 0.35f * own : kind < 0.6f ? 0.86f + 0.16f * own : 1.15f;
    return tone * lerpf(1.0f, mineral, seen);
}

static Vec3 minerals(const Material *m, const SurfacePoint *point, Vec3 color, float joint)
{
    Vec3 p = point->object_position;
    const float patch = 0.05f; // m
    float scale = scale_of(m);
    float stain = noise_fractal(vec3(p.x / scale, 0.35f * p.y / scale, p.z / scale), 4, SEED_STAIN);
    float weathered = smoothstepf(-0.3f, 0.4f, stain) * 0.85f + 0.6f * joint;
    color = vec3_lerp(color, m->color2, clampf(weathered, 0.0f, 1.0f));
    float patches = pattern_detail(0.5f * patch, point->footprint);
    patches *= noise_fractal(vec3_scale(p, 1.0f / patch), 3, SEED_GRAIN + 8);
    color = vec3_scale(color, 1.0f + 0.3f * patches);
    return vec3_scale(color, grain_tone(point));
}

void pattern_stone(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float joint = broken_at(point->object_position, scale_of(m), point->footprint).joint;
    shade->color = minerals(m, point, shade->color, joint);
    bool mossy = false;
    if (m->lichen > 0.0f) {
        Overgrowth lichen = lichen_at(m->lichen, point);
        shade->color = vec3_lerp(shade->color, lichen.color, lichen.share);
    }
    if (m->moss > 0.0f) {
        Overgrowth moss = moss_of(m, point, point->object_position, joint);
        shade->color = vec3_lerp(shade->color, moss.color, moss.share);
        mossy = moss.share > 0.0f;
    }
    if (m->pattern_depth > 0.0f || mossy) {
        Vec3 slope =
            pattern_bump(m, point, mossy ? mossy_relief_at : relief_at, 0.01f * scale_of(m));
        shade->normal = pattern_tilt(shade->normal, slope);
    }
}
