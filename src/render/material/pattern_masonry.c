// A wall of stones in courses: their heights, lengths and tones differ, mortar lies deeper. Courses
// run level; each side of a wall is laid along the axis of the object's space that it faces least.
#include "render/material/overgrowth.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

enum { SEED_WARP = 301, SEED_ROUGH = 304, SEED_STAIN = 308 };

// A stone of the wall, seen from a place on it.
typedef struct Block {
    uint32_t hash;
    float border; // m to its edge; below 0 outside of it
} Block;

static float scale_of(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 0.22f;
}

static uint32_t block_hash(int row, int number)
{
    return (uint32_t)row * 0x9e3779b1u ^ (uint32_t)number * 0x85ebca6bu;
}

// Start of interval i of a line cut at irregular places, of unit mean length.
static float cut_at(int i, uint32_t line)
{
    return (float)i + 0.5f * (noise_unit(block_hash(i, (int)line), 31) - 0.5f);
}

// The interval of x, and its ends.
static int interval_of(float x, uint32_t line, float *low, float *high)
{
    int i = (int)floorf(x);
    i += x >= cut_at(i + 1, line) ? 1 : x < cut_at(i, line) ? -1 : 0;
    *low = cut_at(i, line);
    *high = cut_at(i + 1, line);
    return i;
}

// Distance to the edge of a rectangle with rounded corners, positive inside.
static float rectangle_border(float x, float y, float half_x, float half_y, float round)
{
    float qx = fabsf(x) - (half_x - round), qy = fabsf(y) - (half_y - round);
    float outside = sqrtf(fmaxf(qx, 0.0f) * fmaxf(qx, 0.0f) + fmaxf(qy, 0.0f) * fmaxf(qy, 0.0f));
    return round - outside - fminf(fmaxf(qx, qy), 0.0f);
}

// p: m, in the object's space, on a side that faces n.
static Block block_at(Vec3 p, Vec3 n, float scale)
{
    float ax = fabsf(n.x), ay = fabsf(n.y), az = fabsf(n.z);
    float along = ax > az ? p.z : p.x, up = ay > 0.8f ? (ax > az ? p.x : p.z) : p.y;
    Vec3 q = vec3_scale(p, 1.5f / scale);
    along = along / scale + 0.09f * noise_solid(q, SEED_WARP, NULL);
    up = up / scale + 0.07f * noise_solid(q, SEED_WARP + 1, NULL);
    const float length = 1.7f; // of a stone, in courses' heights
    float bottom, top, left, right;
    int row = interval_of(up, 7, &bottom, &top);
    uint32_t line = block_hash(row, 17);
    float shift = 0.5f * (float)(row & 1) + 0.3f * noise_unit(line, 32); // no joint over another
    int number = interval_of(along / length + shift, line, &left, &right);
    float half_x = 0.5f * length * (right - left), half_y = 0.5f * (top - bottom);
    float x = length * (along / length + shift - 0.5f * (left + right));
    float border = rectangle_border(x, up - 0.5f * (bottom + top), half_x, half_y, 0.14f);
    return (Block){block_hash(row, number), scale * border};
}

// Share of a stone at this distance from its edge; the rest is mortar.
static float stone_share(float border, float scale)
{
    return smoothstepf(0.03f * scale, 0.075f * scale, border);
}

static float relief_at(const Material *m, const SurfacePoint *point, Vec3 p)
{
    float scale = scale_of(m), seen = pattern_detail(scale, point->footprint);
    Block block = block_at(p, surface_smooth_normal(point), scale);
    // Flat faces, dressed by the pick, with worn edges; mortar that the weather has washed out a
    // little.
    float edge = clampf(1.0f - block.border / (0.14f * scale), 0.0f, 1.0f);
    float rough = noise_fractal(vec3_scale(p, 6.0f / scale), 5, SEED_ROUGH);
    float worn = noise_solid(vec3_scale(p, 3.0f / scale), SEED_ROUGH + 1, NULL);
    float face = 0.3f + 0.35f * (noise_unit(block.hash, 33) - 0.5f) -
                 (0.3f + 0.2f * worn) * edge * edge + 0.22f * rough;
    return m->pattern_depth * seen *
           lerpf(-0.42f + 0.2f * rough, face, stone_share(block.border, scale));
}

static Overgrowth moss_of(const Material *m, const SurfacePoint *point, float mortar)
{
    Vec3 n = surface_smooth_normal(point);
    float foot = expf(-fmaxf(point->object_position.y, 0.0f) / 0.4f);
    float damp = clampf(0.15f + 0.7f * n.y, 0.0f, 1.0f) + 0.4f * foot;
    return moss_at(m->moss, point, damp, mortar, 0.01f);
}

float pattern_masonry_height(const Material *m, const SurfacePoint *point)
{
    float height = relief_at(m, point, point->object_position);
    return m->moss > 0.0f ? height + moss_of(m, point, 0.0f).height : height;
}

static Vec3 color_at(const Material *m, const SurfacePoint *point, Vec3 color, float stone,
                     uint32_t hash)
{
    Vec3 p = point->object_position;
    float scale = scale_of(m), seen = pattern_detail(0.2f * scale, point->footprint);
    Vec3 own = vec3_lerp(color, m->color2, 0.9f * noise_unit(hash, 34));
    float hue = 0.12f * (noise_unit(hash, 35) - 0.5f);
    own = vec3(own.x * (1.0f + hue), own.y, own.z * (1.0f - hue));
    float mottle = seen * noise_fractal(vec3_scale(p, 9.0f / scale), 4, SEED_STAIN + 8);
    Vec3 mortar = vec3_lerp(m->color2, vec3(0.30f, 0.28f, 0.24f), 0.45f);
    Vec3 all = vec3_scale(vec3_lerp(mortar, own, stone), 1.0f + 0.35f * mottle);
    // Rain leaves streaks below the wall's edges.
    float stain = noise_fractal(vec3(p.x * 2.2f, p.y * 0.35f, p.z * 2.2f), 3, SEED_STAIN);
    return vec3_scale(all, 1.0f - 0.4f * smoothstepf(0.1f, 0.7f, stain));
}

void pattern_masonry(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = scale_of(m), bump = 1.0f - point->displaced;
    Block block = block_at(point->object_position, surface_smooth_normal(point), scale);
    float stone = lerpf(0.85f, stone_share(block.border, scale),
                        pattern_detail(0.3f * scale, point->footprint));
    shade->color = color_at(m, point, shade->color, stone, block.hash);
    if (m->lichen > 0.0f) {
        Overgrowth lichen = lichen_at(m->lichen, point);
        shade->color = vec3_lerp(shade->color, lichen.color, lichen.share);
    }
    if (m->moss > 0.0f) {
        Overgrowth moss = moss_of(m, point, 1.0f - stone);
        shade->color = vec3_lerp(shade->color, moss.color, moss.share);
        bump *= 1.0f - 0.7f * moss.share;
    }
    if (bump > 0.0f && m->pattern_depth > 0.0f) {
        Vec3 slope = pattern_slope(m, point, relief_at, 0.02f * scale);
        shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, bump));
    }
}
