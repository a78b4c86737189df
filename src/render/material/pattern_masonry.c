// A wall of stones in courses: their heights, lengths and tones differ, each stands out and leans
// by its own amount and has weathered in its own way; mortar lies deeper, where it has not
// crumbled. Courses run level; each side of a wall is laid along the axis of the object's space
// that it faces least. Dressed stone is the same without joints.
#include "render/material/overgrowth.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

enum {
    SEED_WARP = 301,
    SEED_ROUGH = 304,
    SEED_STAIN = 308,
    SEED_BEDS = 320,
    SEED_PITS = 324,
    SEED_MORTAR = 328,
    SEED_FOOT = 332,
    SEED_TONE = 340
};

// A stone of the wall, seen from a place on it.
typedef struct Block {
    float border;         // m to its edge; below 0 outside of it
    float x, y;           // -1..1: place on its face, along the course and up
    float tone, hue;      // 0..1, and so the rest
    float bedded, pitted; // how it has weathered
    float stand;          // how far it stands out
    float lean_x, lean_y; // how far its face leans to either side
    float place;          // where it lay in the quarry
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

// Distance to the edges, in courses' heights: broken off here and there.
static float ragged(float border, Vec3 q)
{
    float chip = noise_solid(vec3_scale(q, 1.9f), SEED_WARP + 2, NULL);
    return border - 0.05f * smoothstepf(0.05f, 0.6f, chip) +
           0.022f * noise_fractal(vec3_scale(q, 5.0f), 2, SEED_ROUGH + 2);
}

// p: m, in the object's space, on a side that faces n.
static Block wall_block(Vec3 p, Vec3 n, float scale)
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
    float y = up - 0.5f * (bottom + top);
    float border = ragged(rectangle_border(x, y, half_x, half_y, 0.1f), q);
    uint32_t hash = block_hash(row, number);
    return (Block){scale * border,       x / half_x,           y / half_y,
                   noise_unit(hash, 34), noise_unit(hash, 35), noise_unit(hash, 37),
                   noise_unit(hash, 38), noise_unit(hash, 33), noise_unit(hash, 39),
                   noise_unit(hash, 40), noise_unit(hash, 36)};
}

// 0..1: a property of dressed stone, which changes over a few stones' lengths.
static float dressed_as(Vec3 p, float scale, uint32_t seed)
{
    return clampf(0.5f + 0.65f * noise_solid(vec3_scale(p, 0.9f / scale), seed, NULL), 0.0f, 1.0f);
}

static Block dressed_block(Vec3 p, float scale)
{
    const float far = 1000.0f; // m
    return (Block){.border = far,
                   .tone = dressed_as(p, scale, SEED_TONE),
                   .hue = 0.7f,
                   .bedded = dressed_as(p, scale, SEED_TONE + 1),
                   .pitted = dressed_as(p, scale, SEED_TONE + 2),
                   .stand = 0.5f};
}

static Block block_at(const Material *m, Vec3 p, Vec3 n)
{
    return m->pattern == PATTERN_MASONRY ? wall_block(p, n, scale_of(m))
                                         : dressed_block(p, scale_of(m));
}

// Share of a stone at this distance from its edge; the rest is mortar.
static float stone_share(float border, float scale)
{
    return smoothstepf(0.025f * scale, 0.065f * scale, border);
}

// How the weather has worn a stone's face, as a share of the depth: along its beds, into pits, and
// by its grain.
static float weathered(const Block *block, Vec3 p, float scale)
{
    Vec3 q = vec3_madd(vec3_scale(p, 1.0f / scale), 3.0f * block->place, vec3(1.0f, 7.0f, 3.0f));
    float beds = noise_fractal(vec3(2.2f * q.x, 8.0f * q.y, 2.2f * q.z), 4, SEED_BEDS);
    float faces = noise_fractal(vec3_scale(q, 3.0f), 3, SEED_ROUGH);
    float pits = smoothstepf(0.1f, 0.5f, noise_fractal(vec3_scale(q, 9.0f), 3, SEED_PITS));
    float grain = noise_fractal(vec3_scale(q, 26.0f), 3, SEED_ROUGH + 3);
    return 0.3f * block->bedded * beds + 0.26f * faces -
           0.45f * block->pitted * block->pitted * pits + 0.05f * grain;
}

// Of the mortar, as a share of the depth: washed out in places, in others nearly flush.
static float mortar_height(Vec3 p, float scale)
{
    float left = noise_fractal(vec3_scale(p, 0.8f / scale), 3, SEED_MORTAR);
    float rough = noise_fractal(vec3_scale(p, 9.0f / scale), 4, SEED_MORTAR + 4);
    return -0.36f + 0.45f * clampf(left, -1.0f, 1.0f) + 0.12f * rough;
}

static float relief_at(const Material *m, const SurfacePoint *point, Vec3 p)
{
    float scale = scale_of(m), seen = pattern_detail(scale, point->footprint);
    Block block = block_at(m, p, surface_smooth_normal(point));
    float worn = noise_solid(vec3_scale(p, 2.3f / scale), SEED_ROUGH + 1, NULL);
    float round = scale * clampf(0.09f + 0.09f * worn, 0.03f, 0.18f);
    float edge = clampf(1.0f - block.border / round, 0.0f, 1.0f);
    float lean = 0.14f * ((block.lean_x - 0.5f) * block.x + (block.lean_y - 0.5f) * block.y);
    float face = 0.26f + 0.4f * (block.stand - 0.5f) + lean - (0.25f + 0.15f * worn) * edge * edge +
                 weathered(&block, p, scale);
    float mortar = fminf(mortar_height(p, scale), face);
    return m->pattern_depth * seen * lerpf(mortar, face, stone_share(block.border, scale));
}

static Overgrowth moss_of(const Material *m, const SurfacePoint *point, float mortar)
{
    Vec3 n = surface_smooth_normal(point);
    float foot = expf(-fmaxf(point->object_position.y, 0.0f) / 0.4f);
    float wet = noise_fractal(vec3_scale(point->object_position, 0.8f), 3, SEED_FOOT + 4);
    float damp = clampf(0.12f + 0.7f * n.y + 0.3f * smoothstepf(0.0f, 0.5f, wet), 0.0f, 1.0f);
    return moss_at(m->moss, point, damp + 0.5f * foot, 0.8f * mortar, 0.01f);
}

float pattern_masonry_height(const Material *m, const SurfacePoint *point)
{
    float height = relief_at(m, point, point->object_position);
    return m->moss > 0.0f ? height + moss_of(m, point, 0.0f).height : height;
}

// What the weather leaves on a wall: dark crusts in streaks below edges and in hollows, pale ones
// where water has washed lime out, damp at the foot. relief: of the depth.
static Vec3 stained(const Material *m, Vec3 p, Vec3 color, float relief)
{
    float scale = scale_of(m);
    Vec3 fall = vec3(1.9f * p.x, 0.32f * p.y, 1.9f * p.z);
    float streak = noise_fractal(fall, 4, SEED_STAIN);
    float crust = smoothstepf(-0.08f, 0.5f, streak - 0.22f * relief);
    float pale = smoothstepf(0.1f, 0.5f, -streak - 0.1f * relief);
    float washed = noise_fractal(vec3_scale(p, 2.5f / scale), 4, SEED_STAIN + 4);
    float hollow = smoothstepf(0.35f, -0.45f, relief);
    color = vec3_scale(color, (1.0f - 0.38f * hollow) * (1.0f + 0.14f * relief));
    color = vec3_lerp(color, vec3_mul(color, vec3(0.4f, 0.41f, 0.38f)), crust);
    color = vec3_lerp(color, vec3_mul(color, vec3(1.3f, 1.3f, 1.25f)),
                      pale * clampf(0.5f + washed, 0.0f, 1.0f));
    float damp = 0.5f + 0.5f * noise_fractal(vec3_scale(p, 1.7f), 3, SEED_FOOT) - 0.9f * p.y;
    damp = smoothstepf(0.0f, 0.7f, damp);
    return vec3_lerp(color, vec3_mul(color, vec3(0.5f, 0.56f, 0.4f)), 0.8f * damp);
}

static Vec3 color_at(const Material *m, const SurfacePoint *point, Vec3 color, float stone,
                     const Block *block)
{
    Vec3 p = point->object_position;
    float scale = scale_of(m), seen = pattern_detail(0.2f * scale, point->footprint);
    Vec3 own = vec3_lerp(color, m->color2, 0.9f * block->tone);
    float hue = 0.22f * (block->hue - 0.5f);
    own = vec3(own.x * (1.0f + hue), own.y, own.z * (1.0f - hue));
    float mottle = seen * noise_fractal(vec3_scale(p, 9.0f / scale), 4, SEED_STAIN + 8);
    Vec3 mortar = vec3_lerp(m->color2, vec3(0.27f, 0.25f, 0.205f), 0.6f);
    Vec3 all = vec3_scale(vec3_lerp(mortar, own, stone), 1.0f + 0.4f * mottle);
    float depth = m->pattern_depth > 0.0f ? m->pattern_depth : 1.0f;
    return stained(m, p, all, relief_at(m, point, p) / depth);
}

void pattern_masonry(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    float scale = scale_of(m), bare = 1.0f;
    Block block = block_at(m, point->object_position, surface_smooth_normal(point));
    float stone = lerpf(0.85f, stone_share(block.border, scale),
                        pattern_detail(0.3f * scale, point->footprint));
    shade->color = color_at(m, point, shade->color, stone, &block);
    if (m->lichen > 0.0f) {
        Overgrowth lichen = lichen_at(m->lichen, point);
        shade->color = vec3_lerp(shade->color, lichen.color, lichen.share);
    }
    if (m->moss > 0.0f) {
        Overgrowth moss = moss_of(m, point, 1.0f - stone);
        shade->color = vec3_lerp(shade->color, moss.color, moss.share);
        bare = 1.0f - 0.7f * moss.share;
    }
    if (m->pattern_depth > 0.0f) {
        Vec3 slope = pattern_bump(m, point, relief_at, 0.02f * scale);
        shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, bare));
    }
}
