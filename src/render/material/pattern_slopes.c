#include "render/material/pattern_slopes.h"

#include "render/material/pattern_noise.h"

enum { SEED_TALUS = 401, SEED_TURF = 441, KERNELS = 5 };

#define STRETCH 6.0f // length of a streak, in widths

// ---- streaks

// The frame of the slope in plan: a unit vector down it, and how far kernels are stretched.
typedef struct Fall {
    float x, z;
    float stretch;
} Fall;

static Fall fall_at(const SurfacePoint *point)
{
    Vec3 n = surface_smooth_normal(point);
    float level = sqrtf(n.x * n.x + n.z * n.z);
    if (level < 1e-4f) {
        return (Fall){1.0f, 0.0f, 1.0f};
    }
    return (Fall){n.x / level, n.z / level, lerpf(1.0f, STRETCH, smoothstepf(0.08f, 0.4f, level))};
}

static float fraction_of(uint32_t hash, int shift)
{
    return (float)((hash >> shift) & 1023u) / 1024.0f;
}

// Adds the kernels of a square of the grid, whose side is a streak's length; lengths in widths.
static void add_kernels(const Fall *fall, float x, float z, int column, int row, uint32_t seed,
                        PatternOctaves *sum)
{
    uint32_t hash = (seed ^ ((uint32_t)column * 0x9e3779b1u)) * 0x85ebca6bu;
    hash = (hash ^ ((uint32_t)row * 0xc2b2ae35u)) * 0x27d4eb2fu;
    for (int i = 0; i < KERNELS; i++) {
        hash = (hash ^ (hash >> 15)) * 0x2c1b3c6du + 0x165667b1u;
        uint32_t bits = hash ^ (hash >> 13);
        float dx = x - STRETCH * ((float)column + fraction_of(bits, 0));
        float dz = z - STRETCH * ((float)row + fraction_of(bits, 10));
        float along = (dx * fall->x + dz * fall->z) / fall->stretch;
        float across = dz * fall->x - dx * fall->z;
        float rest = 1.0f - along * along - across * across;
        if (rest <= 0.0f) {
            continue;
        }
        float weight = bits & (1u << 31) ? 1.0f : -1.0f;
        float tilt = -4.0f * weight * rest, a = along / fall->stretch;
        sum->value += weight * rest * rest;
        sum->slope.x += tilt * (a * fall->x - across * fall->z);
        sum->slope.z += tilt * (a * fall->z + across * fall->x);
    }
}

// Can a kernel about a point of a square cover the place that lies at x, z from its corner?
static bool reaches(const Fall *fall, float x, float z)
{
    const float spare = 1.001f; // for rounding
    float along = fall->stretch * fall->stretch, fx = fall->x * fall->x, fz = fall->z * fall->z;
    float reach_x = spare * sqrtf(along * fx + fz), reach_z = spare * sqrtf(along * fz + fx);
    return x > -reach_x && x < STRETCH + reach_x && z > -reach_z && z < STRETCH + reach_z;
}

PatternOctaves pattern_fall_lines(const SurfacePoint *point, float width, int octaves, float gain,
                                  uint32_t seed)
{
    PatternOctaves sum = {0};
    Fall fall = fall_at(point);
    float height = 1.0f;
    for (int i = 0; i < octaves; i++) {
        float seen = pattern_detail(2.0f * width, point->footprint);
        if (seen <= 0.0f) {
            break;
        }
        PatternOctaves octave = {0};
        float x = point->object_position.x / width, z = point->object_position.z / width;
        int column = (int)floorf(x / STRETCH), row = (int)floorf(z / STRETCH);
        for (int k = 0; k < 9; k++) {
            int c = column + k % 3 - 1, r = row + k / 3 - 1;
            if (reaches(&fall, x - STRETCH * (float)c, z - STRETCH * (float)r)) {
                add_kernels(&fall, x, z, c, r, seed + 0x51ed27u * (uint32_t)i, &octave);
            }
        }
        float share = 0.5f * seen * height;
        sum.value += share * octave.value;
        sum.slope = vec3_madd(sum.slope, share / width, octave.slope);
        width *= 0.5f;
        height *= gain;
    }
    return sum;
}

// ---- things on the ground

Mounds pattern_mounds(const SurfacePoint *point, float density, float size, uint32_t seed)
{
    const float mean = 0.376f; // of the area of a square that its mound covers
    Mounds m = {.share = mean * density, .tone = 0.5f};
    float seen = pattern_detail(1.2f * size, point->footprint);
    if (seen <= 0.0f || density <= 0.0f) {
        return m;
    }
    Vec3 p = vec3_scale(point->object_position, 1.0f / size);
    CellPoint cell = noise_cells(vec3(p.x, 0.5f, p.z), seed);
    float radius =
        noise_unit(cell.cell, 5) < density ? 0.22f + 0.25f * noise_unit(cell.cell, 6) : 0.0f;
    float away = sqrtf(cell.point.x * cell.point.x + cell.point.z * cell.point.z);
    float soft = fmaxf(0.12f * radius, 0.6f * point->footprint / size);
    float share = radius > 0.0f ? 1.0f - smoothstepf(radius - soft, radius + soft, away) : 0.0f;
    m.share = lerpf(m.share, share, seen);
    m.tone = lerpf(0.5f, noise_unit(cell.cell, 7), seen);
    if (share > 0.0f) { // half of a ball, flattened
        float steep = 1.1f * seen * share * away / (radius * radius);
        m.slope = vec3_scale(vec3(cell.point.x, 0.0f, cell.point.z), steep);
    }
    return m;
}

Mounds pattern_tussocks(const SurfacePoint *point, float density, float size, uint32_t seed)
{
    const float least = 0.2f, most = 0.4f; // radius, in squares
    const float mean = PI_F / 3.0f * (least * least + least * most + most * most);
    Mounds m = {.share = mean * density, .tone = 0.5f};
    float seen = pattern_detail(1.2f * size, point->footprint);
    if (seen <= 0.0f || density <= 0.0f) {
        return m;
    }
    // squares of another way for each size
    float turn = (float)(seed & 15u) + 0.5f, cosine = cosf(turn) / size, sine = sinf(turn) / size;
    Vec3 p = point->object_position;
    float x = cosine * p.x - sine * p.z, z = sine * p.x + cosine * p.z;
    float column = floorf(x), row = floorf(z);
    uint32_t square = noise_square((int)column, (int)row, seed);
    bool there = noise_unit(square, 5) < density;
    float radius = lerpf(least, most, noise_unit(square, 6)), room = 1.0f - 2.0f * radius;
    float dx = x - column - radius - room * noise_unit(square, 1);
    float dz = z - row - radius - room * noise_unit(square, 2);
    float away = sqrtf(dx * dx + dz * dz);
    float soft = fmaxf(0.12f * radius, 0.6f * point->footprint / size);
    float share = there ? 1.0f - smoothstepf(radius - soft, radius + soft, away) : 0.0f;
    m.share = lerpf(m.share, share, seen);
    m.tone = lerpf(0.5f, noise_unit(square, 7), seen);
    if (share > 0.0f) { // half of a ball, flattened
        float steep = -1.1f * seen * share / (radius * radius) * away * size;
        m.slope = vec3_scale(vec3(cosine * dx + sine * dz, 0.0f, cosine * dz - sine * dx), steep);
    }
    return m;
}

// ---- covers

// Broken blocks of one size: a plane and a tone each, and dark gaps between them.
static void add_blocks(const SurfacePoint *point, float size, uint32_t seed, Ground *g)
{
    float seen = pattern_detail(1.6f * size, point->footprint);
    if (seen <= 0.0f) {
        return;
    }
    CellPoint cell = noise_cells(vec3_scale(point->object_position, 1.0f / size), seed);
    float gap = 1.0f - smoothstepf(0.0f, fmaxf(0.14f, point->footprint / size), cell.border);
    float tone = 0.85f + 0.62f * noise_unit(cell.cell, 1) - 0.42f * gap;
    g->color = vec3_scale(g->color, lerpf(1.0f, tone, seen));
    Vec3 tilt = {noise_unit(cell.cell, 2) - 0.5f, 0.0f, noise_unit(cell.cell, 3) - 0.5f};
    g->slope = vec3_madd(g->slope, 1.1f * seen, tilt);
}

Ground slopes_talus(const SurfacePoint *point, Vec3 fresh, Vec3 old, float scale)
{
    PatternOctaves patches = pattern_octaves(point, 0.8f * scale, 4, 0.6f, 1.0f, SEED_TALUS);
    PatternOctaves tracks = pattern_fall_lines(point, 0.13f * scale, 3, 0.6f, SEED_TALUS + 8);
    PatternOctaves grit = pattern_octaves(point, 0.10f * scale, 6, 0.66f, 1.0f, SEED_TALUS + 16);
    float age =
        clampf(0.5f - 0.55f * tracks.value + 0.5f * patches.value + 0.25f * grit.value, 0.0f, 1.0f);
    Ground g = {.color = vec3_lerp(fresh, old, age)};
    g.color = vec3_scale(g.color, clampf(1.0f + 0.28f * grit.value, 0.55f, 1.5f));
    g.slope = vec3_madd(vec3_scale(grit.slope, 0.024f * scale), -0.010f * scale, tracks.slope);
    // what rolls far is large; fine debris keeps to the tracks
    float size = 0.024f * scale * (age > 0.5f ? 1.0f : 0.45f);
    add_blocks(point, size, SEED_TALUS + 24, &g);
    add_blocks(point, 0.31f * size, SEED_TALUS + 25, &g);
    Mounds large = pattern_mounds(point, 0.16f * age, 0.07f * scale, SEED_TALUS + 26);
    g.color = vec3_lerp(g.color, vec3_scale(fresh, 0.7f + 0.7f * large.tone), 0.8f * large.share);
    g.slope = vec3_add(g.slope, large.slope);
    return g;
}

static void add_mounds(const SurfacePoint *point, float density, float size, uint32_t seed,
                       Vec3 color, Ground *g)
{
    Mounds m = pattern_mounds(point, clampf(density, 0.0f, 1.0f), size, seed);
    g->color = vec3_lerp(g->color, vec3_scale(color, 0.65f + 0.7f * m.tone), m.share);
    g->slope = vec3_add(vec3_scale(g->slope, 1.0f - 0.6f * m.share), m.slope);
}

Ground slopes_turf(const SurfacePoint *point, const Turf *turf)
{
    float scale = turf->scale, upright = fabsf(surface_smooth_normal(point).y);
    PatternOctaves patches = pattern_octaves(point, scale, 6, 0.62f, 0.7f, SEED_TURF);
    PatternOctaves tufts = pattern_octaves(point, 0.05f * scale, 5, 0.7f, 0.7f, SEED_TURF + 8);
    PatternOctaves tracks = pattern_fall_lines(point, 0.09f * scale, 3, 0.65f, SEED_TURF + 16);
    float steep = smoothstepf(0.95f, 0.78f, upright + 0.04f * patches.value);
    float dry =
        clampf(turf->dry + 0.9f * patches.value + 0.4f * tufts.value + 0.35f * steep * tracks.value,
               0.0f, 1.0f);
    Ground g = {.color = vec3_lerp(turf->lush, turf->straw, dry)};
    float worn = steep * smoothstepf(0.25f, 0.75f,
                                     tracks.value + 0.35f * patches.value + 0.2f * tufts.value);
    g.color = vec3_lerp(g.color, turf->soil, 0.85f * worn);
    float light = 1.0f + 0.45f * tufts.value - 0.12f * steep * tracks.value;
    g.color = vec3_scale(g.color, clampf(light, 0.5f, 1.5f));
    g.slope = vec3_madd(vec3_scale(tufts.slope, 0.012f * scale), 0.02f * scale, patches.slope);
    g.slope = vec3_madd(g.slope, -0.012f * scale * steep, tracks.slope);
    // bushes keep to hollows and to moist patches, stones to worn ground
    float moist = 0.36f - 1.1f * patches.value - 0.3f * turf->dry;
    add_mounds(point, moist, 0.065f * scale, SEED_TURF + 24, turf->bush, &g);
    add_mounds(point, 0.6f * moist, 0.028f * scale, SEED_TURF + 25, turf->bush, &g);
    Vec3 stone = vec3_lerp(vec3_splat(0.2f), turf->soil, 0.5f);
    add_mounds(point, 0.07f + 0.5f * worn, 0.022f * scale, SEED_TURF + 26, stone, &g);
    return g;
}

// color: dry grass; color2: soil. Lush grass and bushes take their tones from color.
void pattern_heath(const Material *m, const SurfacePoint *point, PatternShade *shade)
{
    Vec3 c = shade->color;
    Turf turf = {.straw = c,
                 .lush = vec3(0.52f * c.x, 0.68f * c.y, 0.5f * c.z),
                 .bush = vec3(0.30f * c.x, 0.42f * c.y, 0.36f * c.z),
                 .soil = m->color2,
                 .scale = m->pattern_scale > 0.0f ? m->pattern_scale : 60.0f,
                 .dry = 0.55f};
    Ground g = slopes_turf(point, &turf);
    shade->color = g.color;
    float bump = m->pattern_depth * (1.0f - point->displaced);
    shade->normal = pattern_tilt(shade->normal, vec3_scale(g.slope, bump));
}
