#include "render/cloud/detail.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdlib.h>

enum {
    SIDE = 128,
    MASK = SIDE - 1,
    OCTAVES = 3,
    MOST_CELLS = DETAIL_CELLS << (OCTAVES - 1),
    EDDY_CELLS = 3, // of the curl on the period
    EDDY_SIDE = 32,
    BLOCK = 4, // texels along the side of a block with known bounds
    BLOCKS = SIDE / BLOCK
};

static const float LIGHTEST = 0.7f; // weight of a point of cell noise

typedef struct ByteRange {
    uint8_t low[2], high[2]; // billow, wisp
} ByteRange;

struct DetailNoise {
    uint8_t texel[SIDE][SIDE][SIDE][2];      // z, y, x: billow, wisp
    ByteRange block[BLOCKS][BLOCKS][BLOCKS]; // of all that is interpolated in a block
    ByteRange whole;
};

// A point of cell noise within its cell; distances to it count `weight` times when squared.
typedef struct Seed {
    Vec3 place;
    float weight;
} Seed;

// All that the pictures are made of. 0.7 MB.
typedef struct Tables {
    Seed seed[OCTAVES][MOST_CELLS * MOST_CELLS * MOST_CELLS];
    Vec3 slope[OCTAVES][MOST_CELLS * MOST_CELLS * MOST_CELLS]; // gradients at lattice points
    Vec3 potential[3][EDDY_CELLS * EDDY_CELLS * EDDY_CELLS];   // the same of the eddies' potential
    Vec3 eddy[EDDY_SIDE][EDDY_SIDE][EDDY_SIDE];                // z, y, x: periods
} Tables;

// Of -cells .. 2 cells - 1.
static int wrap(int i, int cells)
{
    return i < 0 ? i + cells : (i >= cells ? i - cells : i);
}

static int cell_at(int x, int y, int z, int cells)
{
    return (wrap(z, cells) * cells + wrap(y, cells)) * cells + wrap(x, cells);
}

// Gradient noise (Perlin 2002) of period `cells`; p in cells.
static float gradient_noise(const Vec3 *slope, int cells, Vec3 p)
{
    int x = (int)floorf(p.x), y = (int)floorf(p.y), z = (int)floorf(p.z);
    Vec3 f = vec3(p.x - (float)x, p.y - (float)y, p.z - (float)z);
    float sum = 0.0f;
    for (int k = 0; k < 8; k++) {
        int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        Vec3 d = vec3(f.x - (float)i, f.y - (float)j, f.z - (float)l);
        Vec3 fade = vec3(i ? f.x : 1.0f - f.x, j ? f.y : 1.0f - f.y, l ? f.z : 1.0f - f.z);
        float weight =
            smoothstepf(0, 1, fade.x) * smoothstepf(0, 1, fade.y) * smoothstepf(0, 1, fade.z);
        sum += weight * vec3_dot(slope[cell_at(x + i, y + j, z + l, cells)], d);
    }
    return sum;
}

// ---- tables ----

static Vec3 potential_at(const Tables *t, Vec3 p)
{
    return vec3(gradient_noise(t->potential[0], EDDY_CELLS, p),
                gradient_noise(t->potential[1], EDDY_CELLS, p),
                gradient_noise(t->potential[2], EDDY_CELLS, p));
}

static void stir(Tables *t)
{
    const float step = 0.05f, strength = 0.055f; // cells, periods
    for (int z = 0; z < EDDY_SIDE; z++) {
        for (int y = 0; y < EDDY_SIDE; y++) {
            for (int x = 0; x < EDDY_SIDE; x++) {
                Vec3 p =
                    vec3_scale(vec3((float)x, (float)y, (float)z), (float)EDDY_CELLS / EDDY_SIDE);
                Vec3 origin = potential_at(t, p);
                Vec3 dx = vec3_sub(potential_at(t, vec3_add(p, vec3(step, 0, 0))), origin);
                Vec3 dy = vec3_sub(potential_at(t, vec3_add(p, vec3(0, step, 0))), origin);
                Vec3 dz = vec3_sub(potential_at(t, vec3_add(p, vec3(0, 0, step))), origin);
                Vec3 curl = vec3(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x);
                t->eddy[z][y][x] = vec3_scale(curl, strength / step);
            }
        }
    }
}

static void fill_tables(Tables *t, uint64_t key)
{
    for (int octave = 0; octave < OCTAVES; octave++) {
        int cells = DETAIL_CELLS << octave;
        for (int i = 0; i < cells * cells * cells; i++) {
            uint64_t own = random_key(random_key(key, (uint64_t)octave), (uint64_t)i);
            t->seed[octave][i] =
                (Seed){vec3(random_unit(own), random_unit(own + 1), random_unit(own + 2)),
                       random_range(own + 3, LIGHTEST, 1.5f)};
            t->slope[octave][i] = random_direction(random_key(own, 4));
        }
    }
    for (int i = 0; i < EDDY_CELLS * EDDY_CELLS * EDDY_CELLS; i++) {
        for (uint64_t axis = 0; axis < 3; axis++) {
            t->potential[axis][i] =
                random_direction(random_key(random_key(key, 100 + axis), (uint64_t)i));
        }
    }
    stir(t);
}

// ---- pictures ----

static Vec3 eddy_at(const Tables *t, int x, int y, int z)
{
    enum { SHARE = SIDE / EDDY_SIDE, LAST = EDDY_SIDE - 1 };
    int i = x / SHARE, j = y / SHARE, k = z / SHARE;
    float u = (float)(x % SHARE) / SHARE, v = (float)(y % SHARE) / SHARE,
          w = (float)(z % SHARE) / SHARE;
    Vec3 sum = vec3_splat(0.0f);
    for (int c = 0; c < 8; c++) {
        int dx = c & 1, dy = c >> 1 & 1, dz = c >> 2;
        float weight = (dx ? u : 1 - u) * (dy ? v : 1 - v) * (dz ? w : 1 - w);
        sum = vec3_madd(sum, weight, t->eddy[(k + dz) & LAST][(j + dy) & LAST][(i + dx) & LAST]);
    }
    return sum;
}

// The cells before, at and after a place along an axis, the nearest first.
typedef struct Neighbours {
    int cell[3];   // on the period
    float side[3]; // its lower side, in cells
    float away[3]; // square of the distance to it
} Neighbours;

static Neighbours neighbours_along(float p, int cells)
{
    static const int order[3] = {0, -1, 1};
    int own = (int)floorf(p);
    float inside = p - (float)own;
    Neighbours n;
    for (int k = 0; k < 3; k++) {
        float away = order[k] == 0 ? 0.0f : (order[k] < 0 ? inside : 1.0f - inside);
        n.cell[k] = wrap(own + order[k], cells);
        n.side[k] = (float)(own + order[k]);
        n.away[k] = 0.999f * LIGHTEST * away * away;
    }
    return n;
}

// Least weighted square of the distance to a point of the cells around, in cells. Cells too far to
// hold a nearer one than is found are left out.
static float nearest(const Seed *seed, int cells, Vec3 p)
{
    Neighbours x = neighbours_along(p.x, cells), y = neighbours_along(p.y, cells),
               z = neighbours_along(p.z, cells);
    float best = 3.0f;
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3 && z.away[k] < best; j++) {
            const Seed *row = seed + (int64_t)(z.cell[k] * cells + y.cell[j]) * cells;
            float away = z.away[k] + y.away[j];
            for (int i = 0; i < 3 && away < best; i++) {
                const Seed *s = &row[x.cell[i]];
                Vec3 d = vec3_sub(vec3_add(vec3(x.side[i], y.side[j], z.side[k]), s->place), p);
                float square = s->weight * vec3_dot(d, d);
                best = square < best ? square : best;
            }
        }
    }
    return best;
}

// Paraboloids about the points: round outward, and creases between.
static float billow(const Tables *t, Vec3 p)
{
    float sum = 0.0f, weight = 0.56f;
    for (int octave = 0; octave < OCTAVES; octave++, weight *= 0.5f) {
        int cells = DETAIL_CELLS << octave;
        sum +=
            weight * (0.72f - 2.1f * nearest(t->seed[octave], cells, vec3_scale(p, (float)cells)));
    }
    return clampf(1.25f * sum, -1.0f, 1.0f);
}

static float wisp(const Tables *t, Vec3 p)
{
    float sum = 0.0f, weight = 1.1f;
    for (int octave = 0; octave < OCTAVES; octave++, weight *= 0.55f) {
        int cells = DETAIL_CELLS << octave;
        sum += weight * gradient_noise(t->slope[octave], cells, vec3_scale(p, (float)cells));
    }
    return clampf(sum, -1.0f, 1.0f);
}

static uint8_t in_bytes(float value)
{
    return (uint8_t)lrintf(127.5f + 127.5f * value);
}

// ---- bounds ----

static ByteRange empty_range(void)
{
    return (ByteRange){{255, 255}, {0, 0}};
}

static void unite(ByteRange *a, ByteRange b)
{
    for (int i = 0; i < 2; i++) {
        a->low[i] = b.low[i] < a->low[i] ? b.low[i] : a->low[i];
        a->high[i] = b.high[i] > a->high[i] ? b.high[i] : a->high[i];
    }
}

static void fill_bounds(DetailNoise *n)
{
    enum { ACROSS = BLOCK + 1 }; // what lies in a block is interpolated with the next one's first
    n->whole = empty_range();
    for (int i = 0; i < BLOCKS * BLOCKS * BLOCKS; i++) {
        int x = i % BLOCKS, y = i / BLOCKS % BLOCKS, z = i / (BLOCKS * BLOCKS);
        ByteRange range = empty_range();
        for (int k = 0; k < ACROSS * ACROSS * ACROSS; k++) {
            const uint8_t *t =
                n->texel[(z * BLOCK + k / (ACROSS * ACROSS)) & MASK]
                        [(y * BLOCK + k / ACROSS % ACROSS) & MASK][(x * BLOCK + k % ACROSS) & MASK];
            unite(&range, (ByteRange){{t[0], t[1]}, {t[0], t[1]}});
        }
        n->block[z][y][x] = range;
        unite(&n->whole, range);
    }
}

static float from_byte(int byte)
{
    return (float)byte * (1.0f / 127.5f) - 1.0f;
}

static DetailRange from_bytes(ByteRange r)
{
    return (DetailRange){{from_byte(r.low[0]), from_byte(r.low[1])},
                         {from_byte(r.high[0]), from_byte(r.high[1])}};
}

DetailRange detail_range_whole(const DetailNoise *n)
{
    return from_bytes(n->whole);
}

DetailRange detail_range(const DetailNoise *n, Vec3 middle, Vec3 half)
{
    Vec3 a = vec3_scale(vec3_sub(middle, half), BLOCKS);
    Vec3 b = vec3_scale(vec3_add(middle, half), BLOCKS);
    if (2.0f * vec3_largest(vec3_sub(b, a)) > BLOCKS) {
        return detail_range_whole(n);
    }
    ByteRange range = empty_range();
    const int wrap = BLOCKS - 1;
    for (int z = (int)floorf(a.z); z <= (int)floorf(b.z); z++) {
        for (int y = (int)floorf(a.y); y <= (int)floorf(b.y); y++) {
            for (int x = (int)floorf(a.x); x <= (int)floorf(b.x); x++) {
                unite(&range, n->block[z & wrap][y & wrap][x & wrap]);
            }
        }
    }
    return from_bytes(range);
}

// ---- making ----

DetailNoise *detail_new(uint64_t key, const Run *run, Error *e)
{
    Tables *tables = memory_alloc(1, sizeof *tables, e);
    DetailNoise *noise = tables ? memory_alloc_wide(1, sizeof *noise, e) : NULL;
    if (!noise) {
        free(tables);
        return NULL;
    }
    fill_tables(tables, key);
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int z = 0; z < SIDE; z++) {
        for (int i = 0; i < SIDE * SIDE; i++) {
            int x = i % SIDE, y = i / SIDE;
            Vec3 p = vec3_scale(vec3((float)x, (float)y, (float)z), 1.0f / SIDE);
            Vec3 eddy = eddy_at(tables, x, y, z);
            uint8_t *texel = noise->texel[z][y][x];
            texel[0] = in_bytes(billow(tables, vec3_madd(p, 0.4f, eddy)));
            texel[1] = in_bytes(wisp(tables, vec3_add(p, eddy)));
        }
    }
    free(tables);
    fill_bounds(noise);
    return noise;
}

void detail_free(DetailNoise *noise)
{
    free(noise);
}

// ---- looking up ----

static Detail row(const DetailNoise *n, int z, int y, int x, float u)
{
    const uint8_t *a = n->texel[z & MASK][y & MASK][x & MASK];
    const uint8_t *b = n->texel[z & MASK][y & MASK][(x + 1) & MASK];
    return (Detail){lerpf(a[0], b[0], u), lerpf(a[1], b[1], u)};
}

static Detail between(Detail a, Detail b, float t)
{
    return (Detail){lerpf(a.billow, b.billow, t), lerpf(a.wisp, b.wisp, t)};
}

Detail detail_at(const DetailNoise *n, Vec3 p)
{
    p = vec3_scale(p, SIDE);
    float fx = floorf(p.x), fy = floorf(p.y), fz = floorf(p.z);
    int x = (int)fx, y = (int)fy, z = (int)fz;
    float u = p.x - fx, v = p.y - fy, w = p.z - fz;
    Detail near = between(row(n, z, y, x, u), row(n, z, y + 1, x, u), v);
    Detail far = between(row(n, z + 1, y, x, u), row(n, z + 1, y + 1, x, u), v);
    Detail d = between(near, far, w);
    return (Detail){d.billow * (1.0f / 127.5f) - 1.0f, d.wisp * (1.0f / 127.5f) - 1.0f};
}
