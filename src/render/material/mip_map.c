#include "render/material/mip_map.h"

#include "base/memory.h"

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>

#include <math.h>
#include <stdlib.h>

// No size is halved more than 31 times. A patch longer than 32 times its width is widened.
enum { MOST_LEVELS = 32, MOST_PROBES = 32 };
#define FARTHEST 1e9 // texels, so that their differences are ints

// One resolution: the texels at left, top of a picture of size[0] by size[1].
typedef struct Level {
    int size[2];
    int start[2], count[2]; // of the texels, along x and y
    void *data;             // count[1] rows of count[0] texels
} Level;

struct MipMap {
    int channels;
    TexelType type;
    int count;
    Level level[MOST_LEVELS]; // [0].data is the caller's
};

// ---- texels ----

static float value_at(TexelType type, const void *data, size_t i)
{
    switch (type) {
    case TEXEL_BYTE:
        return (float)((const uint8_t *)data)[i] * (1.0f / 255.0f);
    case TEXEL_SHORT:
        return (float)((const uint16_t *)data)[i] * (1.0f / 65535.0f);
    case TEXEL_HALF:
        return imath_half_to_float(((const imath_half_bits_t *)data)[i]);
    default:
        return ((const float *)data)[i];
    }
}

static void set_value(TexelType type, void *data, size_t i, float value)
{
    switch (type) {
    case TEXEL_BYTE:
        ((uint8_t *)data)[i] = (uint8_t)(value * 255.0f + 0.5f);
        break;
    case TEXEL_SHORT:
        ((uint16_t *)data)[i] = (uint16_t)(value * 65535.0f + 0.5f);
        break;
    case TEXEL_HALF:
        ((imath_half_bits_t *)data)[i] = imath_float_to_half(value);
        break;
    default:
        ((float *)data)[i] = value;
    }
}

// Adds the weighted texel at x, y of the level's picture.
static void add_texel(const MipMap *map, const Level *level, int x, int y, float weight,
                      int channels, float sum[])
{
    int column = x - level->start[0], row = y - level->start[1];
    if (column < 0 || column >= level->count[0] || row < 0 || row >= level->count[1]) {
        return;
    }
    size_t i = ((size_t)row * (size_t)level->count[0] + (size_t)column) * (size_t)map->channels;
    for (int c = 0; c < channels; c++) {
        sum[c] += weight * value_at(map->type, level->data, i + (size_t)c);
    }
}

// ---- halving ----

// The texels of a finer level that lie below texel i of one of `size`, with their shares: one to
// three, since an odd size is not halved evenly.
typedef struct Below {
    int first, count;
    float share[4];
} Below;

static Below below(int i, int size, int finer)
{
    double scale = (double)finer / size, from = i * scale, to = (i + 1) * scale;
    Below b = {.first = (int)from};
    for (int k = b.first; k < finer && k < to && b.count < 4; k++) {
        double part = fmin(to, k + 1.0) - fmax(from, k);
        b.share[b.count++] = (float)(part / scale);
    }
    return b;
}

// The size of the next level and which of its texels are not empty.
static Level halved(const Level *fine)
{
    Level level = {.data = NULL};
    for (int axis = 0; axis < 2; axis++) {
        int size = fine->size[axis] > 1 ? fine->size[axis] / 2 : 1;
        double scale = (double)size / fine->size[axis];
        double from = fmax(fine->start[axis], 0.0);
        double to = fmin((double)fine->start[axis] + fine->count[axis], fine->size[axis]);
        level.size[axis] = size;
        level.start[axis] = (int)fmin(floor(from * scale), size - 1.0);
        level.count[axis] = to > from ? (int)(ceil(to * scale) - level.start[axis]) : 0;
    }
    return level;
}

static void average(const MipMap *map, const Level *fine, Level *level, float *sum)
{
    size_t at = 0;
    for (int y = 0; y < level->count[1]; y++) {
        Below rows = below(level->start[1] + y, level->size[1], fine->size[1]);
        for (int x = 0; x < level->count[0]; x++) {
            Below columns = below(level->start[0] + x, level->size[0], fine->size[0]);
            for (int c = 0; c < map->channels; c++) {
                sum[c] = 0.0f;
            }
            for (int k = 0; k < rows.count * columns.count; k++) {
                int row = k / columns.count, column = k % columns.count;
                add_texel(map, fine, columns.first + column, rows.first + row,
                          rows.share[row] * columns.share[column], map->channels, sum);
            }
            for (int c = 0; c < map->channels; c++) {
                set_value(map->type, level->data, at++, sum[c]);
            }
        }
    }
}

static bool add_levels(MipMap *map, Error *e)
{
    float *sum = memory_alloc(map->channels, sizeof *sum, e);
    bool done = sum;
    for (const Level *fine = map->level;
         done && (fine->size[0] > 1 || fine->size[1] > 1) && map->count < MOST_LEVELS; fine++) {
        Level *level = &map->level[map->count];
        *level = halved(fine);
        level->data = memory_alloc((int64_t)level->count[0] * level->count[1],
                                   (size_t)map->channels * (size_t)texel_bytes(map->type), e);
        done = level->data;
        if (done) {
            average(map, fine, level, sum);
            map->count++;
        }
    }
    free(sum);
    return done;
}

MipMap *mip_map_new(const Texels *texels, Error *e)
{
    MipMap *map = memory_alloc_zero(1, sizeof *map, e);
    if (!map) {
        return NULL;
    }
    map->channels = texels->channels;
    map->type = texels->type;
    map->count = 1;
    map->level[0] = (Level){.count = {texels->width, texels->height}, .data = texels->data};
    for (int axis = 0; axis < 2; axis++) { // the file's numbers, which may be any
        double start = (double)texels->window[axis] - texels->window[2 + axis];
        map->level[0].start[axis] = (int)fmin(fmax(start, -FARTHEST), FARTHEST);
        map->level[0].size[axis] = (int)fmin(texels->window[4 + axis], FARTHEST);
    }
    if (!add_levels(map, e)) {
        mip_map_free(map);
        return NULL;
    }
    return map;
}

void mip_map_free(MipMap *map)
{
    for (int i = 1; map && i < map->count; i++) {
        free(map->level[i].data);
    }
    free(map);
}

// ---- lookups ----

static int wrap(int i, int size)
{
    int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

// The texels that one coordinate meets along an axis, 0..1 from the start of the picture, with
// their weights: two by linear interpolation, four by a cubic B-spline.
typedef struct Taps {
    int at[4], count;
    float weight[4];
} Taps;

static Taps taps(float coordinate, int size, bool cubic)
{
    float x = coordinate * (float)size - 0.5f, whole = floorf(x), t = x - whole, s = 1.0f - t;
    Taps result = {.count = 2, .weight = {s, t}};
    if (cubic) {
        result = (Taps){.count = 4,
                        .weight = {s * s * s / 6.0f, 2.0f / 3.0f - 0.5f * t * t * (2.0f - t),
                                   2.0f / 3.0f - 0.5f * s * s * (2.0f - s), t * t * t / 6.0f}};
    }
    for (int i = 0; i < result.count; i++) {
        result.at[i] = wrap((int)whole + i - (cubic ? 1 : 0), size);
    }
    return result;
}

static void add_level(const MipMap *map, int number, const float at[2], float weight, int channels,
                      float sum[4])
{
    const Level *level = &map->level[number];
    bool cubic = number == 0;
    Taps x = taps(at[0], level->size[0], cubic), y = taps(at[1], level->size[1], cubic);
    for (int j = 0; j < y.count; j++) {
        for (int i = 0; i < x.count; i++) {
            add_texel(map, level, x.at[i], y.at[j], weight * x.weight[i] * y.weight[j], channels,
                      sum);
        }
    }
}

// The part of x after the point; 0 for what is not finite.
static float fraction(float x)
{
    float part = x - floorf(x);
    return part >= 0.0f && part < 1.0f ? part : 0.0f;
}

void mip_map_lookup(const MipMap *map, Vec2 uv, float du, float dv, int channels, float value[])
{
    const float most = 1e6f; // pictures; also for footprints that are not finite
    const float patch[2] = {fminf(fabsf(du), most), fminf(fabsf(dv), most)};
    float wide = patch[0] * (float)map->level[0].size[0],
          high = patch[1] * (float)map->level[0].size[1];
    int axis = wide >= high ? 0 : 1; // the longer one, along which several probes are taken
    float longer = fmaxf(wide, high),
          shorter = fmaxf(fmaxf(fminf(wide, high), longer / MOST_PROBES), 1.0f);
    float height = fminf(log2f(shorter), (float)(map->count - 1));
    int lower = (int)height, upper = lower + 1 < map->count ? lower + 1 : lower;
    float blend = height - (float)lower;
    int probes = (int)ceilf(fmaxf(longer / shorter, 1.0f));
    for (int c = 0; c < channels; c++) {
        value[c] = 0.0f;
    }
    for (int i = 0; i < probes; i++) {
        float at[2] = {uv.x, 1.0f - uv.y};
        at[axis] += (((float)i + 0.5f) / (float)probes - 0.5f) * patch[axis];
        at[0] = fraction(at[0]);
        at[1] = fraction(at[1]);
        float weight = 1.0f / (float)probes;
        add_level(map, lower, at, weight * (1.0f - blend), channels, value);
        if (blend > 0.0f) {
            add_level(map, upper, at, weight * blend, channels, value);
        }
    }
}
