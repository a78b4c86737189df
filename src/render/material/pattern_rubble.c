// Rubble masonry: rough stones of all sizes, broadly in courses, bedded in lime mortar. Each course
// is cut into blocks, and most blocks again into smaller stones, along slanted joints. Frost and
// rain have worn the mortar back: grains of sand and small stones stand out of it, it has shrunk
// from some stones and lies over the edges of others.
#include "render/material/overgrowth.h"
#include "render/material/pattern.h"
#include "render/material/pattern_noise.h"

#include <math.h>
#include <stddef.h>

enum {
    SEED_WARP = 401,
    SEED_EDGE = 406,
    SEED_FACE = 412,
    SEED_PITS = 420,
    SEED_GRAIN = 424,
    SEED_MORTAR = 430,
    SEED_SAND = 438,
    SEED_STAIN = 442,
    SEED_DAMP = 450,
    SEED_TONE = 456
};

static const float grain_size = 0.0026f;  // m, of the sand in the mortar
static const float pebble_size = 0.0085f; // m, of the largest stones in it

// A place on the wall as one of its stones has it. Lengths are in pattern_scale.
typedef struct Stone {
    float left, right, low, high; // distances to its four sides, before corners are rounded
    uint32_t hash;
    float border; // distance to its edge; below 0 in the mortar
} Stone;

// What the wall is like at a place.
typedef struct Rubble {
    Stone stone;
    float share;   // 1 on the stone, 0 on mortar
    float face;    // height of the stone's face, in pattern_depth
    float mortar;  // of the mortar, likewise
    float height;  // of the wall: the two of them mixed
    uint32_t sand; // hash of the grain of sand here
    float grain;   // 0..1: how far inside of that grain
    float pebble;  // 0..1: share of a pebble in the mortar
} Rubble;

static float scale_of(const Material *m)
{
    return m->pattern_scale > 0.0f ? m->pattern_scale : 0.13f;
}

static uint32_t mixed(uint32_t a, uint32_t b)
{
    uint32_t h = a * 0x9e3779b1u ^ b * 0x85ebca6bu;
    h ^= h >> 15;
    return h * 0x2c1b3c6du;
}

// Start of interval i of a line cut at irregular places, of unit mean length.
static float cut_at(int i, uint32_t line)
{
    return (float)i + 0.5f * (noise_unit(mixed((uint32_t)i, line), 1) - 0.5f);
}

static int interval_of(float x, uint32_t line, float *low, float *high)
{
    int i = (int)floorf(x);
    i += x >= cut_at(i + 1, line) ? 1 : x < cut_at(i, line) ? -1 : 0;
    *low = cut_at(i, line);
    *high = cut_at(i + 1, line);
    return i;
}

// Divides the stone by a joint, upright or level, and keeps the part that the place is in.
static void divide(Stone *s, bool upright)
{
    float width = s->left + s->right, height = s->low + s->high;
    float at = lerpf(0.3f, 0.7f, noise_unit(s->hash, 11));
    float slant = 0.34f * (noise_unit(s->hash, 12) - 0.5f);
    float beyond = upright ? s->left - at * width + slant * (s->low - 0.5f * height)
                           : s->low - at * height + slant * (s->left - 0.5f * width);
    float *nearer =
        upright ? (beyond > 0.0f ? &s->left : &s->right) : (beyond > 0.0f ? &s->low : &s->high);
    *nearer = fabsf(beyond);
    s->hash = mixed(s->hash, beyond > 0.0f ? 21u : 22u);
}

// Distance to the edge of the stone with rounded corners.
static float rounded(const Stone *s)
{
    float x = fminf(s->left, s->right), y = fminf(s->low, s->high);
    float least = fminf(s->left + s->right, s->low + s->high);
    float round = fminf(lerpf(0.05f, 0.26f, noise_unit(s->hash, 13)), 0.45f * least);
    if (x >= round || y >= round) {
        return fminf(x, y);
    }
    return round - sqrtf((round - x) * (round - x) + (round - y) * (round - y));
}

// The stone at p (m, in the object's space) on a side that faces n.
static Stone stone_at(Vec3 p, Vec3 n, float scale)
{
    enum { DIVISIONS = 3 };
    const float course = 1.9f, length = 2.9f; // of the blocks that stones are cut from
    float ax = fabsf(n.x), ay = fabsf(n.y), az = fabsf(n.z);
    Vec3 q = vec3_scale(p, 1.0f / scale);
    float along = ax > az ? q.z : q.x, up = ay > 0.8f ? (ax > az ? q.x : q.z) : q.y;
    along += 0.20f * noise_solid(vec3_scale(q, 0.6f), SEED_WARP, NULL);
    up += 0.24f * noise_solid(vec3_scale(q, 0.35f), SEED_WARP + 1, NULL) +
          0.07f * noise_solid(vec3_scale(q, 1.1f), SEED_WARP + 2, NULL);
    float low, high, left, right;
    int row = interval_of(up / course, 7, &low, &high);
    uint32_t line = mixed((uint32_t)row, 17);
    float at = along / length + 0.5f * (float)(row & 1) + 0.4f * noise_unit(line, 2);
    int number = interval_of(at, line, &left, &right);
    Stone s = {.left = length * (at - left),
               .right = length * (right - at),
               .low = up - course * low,
               .high = course * high - up,
               .hash = mixed(line, (uint32_t)number)};
    for (int i = 0; i < DIVISIONS; i++) {
        float width = s.left + s.right, height = s.low + s.high;
        bool large = width > 2.3f || height > 1.5f;
        if (large || (width * height > 0.9f && noise_unit(s.hash, 14) < 0.5f)) {
            divide(&s, width > lerpf(1.4f, 2.4f, noise_unit(s.hash, 15)) * height);
        }
    }
    float chip = noise_solid(vec3_scale(q, 2.1f), SEED_EDGE, NULL);
    float wide = 0.062f + 0.045f * noise_solid(vec3_scale(q, 0.8f), SEED_EDGE + 1, NULL);
    s.border = rounded(&s) - wide - 0.09f * smoothstepf(0.0f, 0.5f, chip) +
               0.045f * noise_fractal(vec3_scale(q, 4.5f), 3, SEED_EDGE + 2);
    return s;
}

// -1..1, with sharp crests: broken stone.
static float broken(Vec3 p, int octaves, uint32_t seed)
{
    float sum = 0.0f, height = 1.0f;
    for (int i = 0; i < octaves; i++) {
        sum += height * (0.45f - 1.6f * fabsf(noise_solid(p, seed + (uint32_t)i, NULL)));
        p = vec3_add(vec3_scale(p, 2.1f), vec3_splat(3.7f));
        height *= 0.5f;
    }
    return sum;
}

// Height of a stone's face, in pattern_depth: how it was set and broken, and how it has weathered:
// along its beds, into pits, by its grain.
static float face_of(const Stone *s, Vec3 p, float scale)
{
    float own = 5.0f * noise_unit(s->hash, 30);
    Vec3 q = vec3_madd(vec3_scale(p, 1.0f / scale), own, vec3(1.0f, 7.0f, 3.0f));
    float width = fmaxf(s->left + s->right, 0.2f), height = fmaxf(s->low + s->high, 0.2f);
    float lean_x = noise_unit(s->hash, 31) - 0.5f, lean_y = noise_unit(s->hash, 32) - 0.5f;
    float set = 0.5f * (noise_unit(s->hash, 33) - 0.5f) +
                0.45f * lean_x * (s->left / width - 0.5f) +
                0.5f * lean_y * (s->low / height - 0.5f);
    float bedded = noise_unit(s->hash, 34), pitted = noise_unit(s->hash, 35);
    float beds = noise_fractal(vec3(1.3f * q.x, 6.0f * q.y, 1.3f * q.z), 4, SEED_FACE);
    float faces = broken(vec3_scale(q, 0.8f), 5, SEED_FACE + 4);
    float where = smoothstepf(-0.2f, 0.5f, noise_solid(vec3_scale(q, 1.4f), SEED_PITS + 3, NULL));
    float pits = where * smoothstepf(0.05f, 0.6f, noise_fractal(vec3_scale(q, 7.0f), 4, SEED_PITS));
    float grain = noise_fractal(vec3_scale(p, 1.0f / 0.007f), 3, SEED_GRAIN);
    float edge =
        clampf(1.0f - s->border / lerpf(0.04f, 0.16f, noise_unit(s->hash, 36)), 0.0f, 1.0f);
    return 0.35f + set + 0.3f * faces + 0.22f * bedded * bedded * beds -
           0.3f * pitted * pitted * pitted * pits + 0.035f * grain - 0.34f * edge * edge;
}

// The mortar at p, and the grain of sand there.
static void add_mortar(const Material *m, const SurfacePoint *point, Vec3 p, Rubble *r)
{
    float scale = scale_of(m), depth = fmaxf(m->pattern_depth, 1e-4f);
    float washed = noise_fractal(vec3_scale(p, 0.9f / scale), 3, SEED_MORTAR);
    float trowel = noise_fractal(vec3_scale(p, 1.0f / 0.030f), 4, SEED_MORTAR + 3);
    float shrunk =
        smoothstepf(0.0f, 0.35f, noise_solid(vec3_scale(p, 0.7f / scale), SEED_MORTAR + 7, NULL));
    float gap = smoothstepf(-0.035f, -0.005f, r->stone.border) * shrunk;
    float height = depth * (-0.12f + 0.34f * clampf(washed, -1.0f, 1.0f) - 0.16f * gap);
    height += 0.0028f * trowel;
    float seen = pattern_detail(1.5f * grain_size, point->footprint);
    r->grain = 0.5f;
    r->sand = 0;
    if (seen > 0.0f) {
        CellPoint sand = noise_cells(vec3_scale(p, 1.0f / grain_size), SEED_SAND);
        r->grain = smoothstepf(0.0f, 0.35f, sand.border);
        r->sand = sand.cell;
        height += seen * 0.0007f * (r->grain - 0.5f) * (0.3f + noise_unit(sand.cell, 41));
    }
    CellPoint stone = noise_cells(vec3_scale(p, 1.0f / pebble_size), SEED_SAND + 1);
    float size = lerpf(0.18f, 0.42f, noise_unit(stone.cell, 42));
    bool lies = noise_unit(stone.cell, 43) < 0.28f;
    float inside = 1.0f - vec3_length(stone.point) / size;
    r->pebble =
        lies ? smoothstepf(0.0f, 0.15f, inside) * pattern_detail(pebble_size, point->footprint)
             : 0.0f;
    height += 0.0022f * r->pebble * (0.4f + 0.6f * clampf(inside, 0.0f, 1.0f));
    r->mortar = height / depth;
}

static Rubble rubble_at(const Material *m, const SurfacePoint *point, Vec3 p)
{
    float scale = scale_of(m);
    Rubble r = {.stone = stone_at(p, surface_smooth_normal(point), scale)};
    r.face = face_of(&r.stone, p, scale);
    add_mortar(m, point, p, &r);
    // Where mortar laps over an edge, the joint is where the two heights meet.
    float lap = 0.05f * (r.face - r.mortar - 0.45f);
    r.share = smoothstepf(-0.012f, 0.022f, r.stone.border + clampf(lap, -0.04f, 0.02f));
    r.height = lerpf(fminf(r.mortar, r.face + 0.2f), r.face, r.share);
    return r;
}

static float relief_at(const Material *m, const SurfacePoint *point, Vec3 p)
{
    return m->pattern_depth * pattern_detail(scale_of(m), point->footprint) *
           rubble_at(m, point, p).height;
}

// share: of mortar.
static Overgrowth moss_of(const Material *m, const SurfacePoint *point, float share)
{
    Vec3 n = surface_smooth_normal(point);
    float foot = expf(-fmaxf(point->object_position.y, 0.0f) / 0.4f);
    float wet = noise_fractal(vec3_scale(point->object_position, 1.6f), 3, SEED_DAMP);
    float damp = 0.2f + 0.7f * n.y + 0.35f * smoothstepf(-0.1f, 0.5f, wet) + 0.5f * foot;
    return moss_at(m->moss, point, clampf(damp, 0.0f, 1.5f), 1.5f * share - 0.4f, 0.007f);
}

float pattern_rubble_height(const Material *m, const SurfacePoint *point)
{
    Rubble r = rubble_at(m, point, point->object_position);
    float height = m->pattern_depth * pattern_detail(scale_of(m), point->footprint) * r.height;
    return m->moss > 0.0f ? height + moss_of(m, point, 1.0f - r.share).height : height;
}

static Vec3 mortar_color(const Material *m, const Rubble *r, Vec3 p)
{
    float patch = noise_fractal(vec3_scale(p, 1.0f / 0.07f), 3, SEED_MORTAR + 10);
    Vec3 color = vec3_scale(m->mortar, 1.0f + 0.22f * patch);
    // Sand: quartz, ochre, dark minerals; lime between them.
    float kind = noise_unit(r->sand, 44);
    Vec3 grain = kind < 0.12f   ? vec3(0.10f, 0.085f, 0.07f)
                 : kind < 0.35f ? vec3(0.33f, 0.23f, 0.13f)
                 : kind < 0.6f  ? vec3(0.52f, 0.49f, 0.43f)
                                : color;
    color = vec3_lerp(color, grain, 0.55f * r->grain * (r->sand != 0));
    Vec3 pebble =
        vec3_lerp(vec3(0.19f, 0.165f, 0.14f), vec3(0.42f, 0.36f, 0.28f), 0.5f + 0.5f * patch);
    return vec3_lerp(color, pebble, 0.8f * r->pebble);
}

static Vec3 stone_color(const Material *m, Vec3 color, const Stone *s, const SurfacePoint *point)
{
    Vec3 p = point->object_position;
    float tone = noise_unit(s->hash, 51), hue = 0.4f * (noise_unit(s->hash, 52) - 0.5f);
    Vec3 own = vec3_lerp(color, m->color2, tone);
    own = vec3(own.x * (1.0f + hue), own.y, own.z * (1.0f - 1.2f * hue));
    float iron =
        smoothstepf(0.15f, 0.7f, noise_fractal(vec3_scale(p, 1.0f / 0.055f), 4, SEED_TONE));
    own = vec3_lerp(own, vec3_mul(own, vec3(1.15f, 0.85f, 0.55f)), iron * noise_unit(s->hash, 53));
    float mottle = noise_fractal(vec3_scale(p, 1.0f / 0.018f), 3, SEED_TONE + 4);
    float speck = pattern_detail(0.003f, point->footprint) *
                  noise_fractal(vec3_scale(p, 1.0f / 0.0028f), 2, SEED_TONE + 8);
    return vec3_scale(own, fmaxf(1.0f + 0.28f * mottle + 0.42f * speck, 0.1f));
}

// Soot and algae in streaks and in hollows, lime washed over the stones below the joints.
static Vec3 stained(const Rubble *r, Vec3 p, Vec3 color)
{
    float streak = noise_fractal(vec3(5.0f * p.x, 0.9f * p.y, 5.0f * p.z), 4, SEED_STAIN);
    float cloud = noise_fractal(vec3_scale(p, 1.0f / 0.04f), 4, SEED_STAIN + 4);
    float hollow = smoothstepf(0.3f, -0.5f, r->height);
    float crust = smoothstepf(-0.05f, 0.5f, streak + 0.35f * cloud - 0.25f * r->height);
    color = vec3_lerp(color, vec3_mul(color, vec3(0.42f, 0.42f, 0.38f)), 0.8f * crust);
    float green = smoothstepf(0.0f, 0.5f,
                              noise_fractal(vec3_scale(p, 2.3f), 3, SEED_STAIN + 8) + 0.3f * cloud);
    color = vec3_lerp(color, vec3_mul(color, vec3(0.62f, 0.68f, 0.42f)), 0.6f * green);
    float lime = smoothstepf(0.15f, 0.5f, cloud - 0.4f * streak) * r->share;
    color = vec3_lerp(color, vec3(0.42f, 0.40f, 0.35f), 0.3f * lime);
    return vec3_scale(color, 1.0f - 0.3f * hollow);
}

void pattern_rubble(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    Vec3 p = point->object_position;
    float bare = 1.0f;
    Rubble r = rubble_at(m, point, p);
    Vec3 color =
        vec3_lerp(mortar_color(m, &r, p), stone_color(m, shade->color, &r.stone, point), r.share);
    shade->color = stained(&r, p, color);
    if (m->lichen > 0.0f) {
        Overgrowth lichen = lichen_at(m->lichen, point);
        float areole = noise_cells(vec3_scale(p, 1.0f / 0.0028f), SEED_TONE + 12).border;
        float cracked = 0.7f + 0.4f * smoothstepf(0.0f, 0.2f, areole);
        shade->color = vec3_lerp(shade->color, vec3_scale(lichen.color, cracked), lichen.share);
    }
    if (m->moss > 0.0f) {
        Overgrowth moss = moss_of(m, point, 1.0f - r.share);
        shade->color = vec3_lerp(shade->color, moss.color, moss.share);
        bare = 1.0f - 0.7f * moss.share;
    }
    if (m->pattern_depth > 0.0f) {
        Vec3 slope = pattern_bump(m, point, relief_at, 0.001f);
        shade->normal = pattern_tilt(shade->normal, vec3_scale(slope, bare));
    }
}
