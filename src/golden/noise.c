#include "golden/noise.h"

#include "base/memory.h"
#include "golden/student.h"

#include <math.h>
#include <stdlib.h>

// Sums over a block's pixels of one channel of both pictures.
typedef struct Sums {
    double pixels, a, b, variance_a, variance_b;
    double squares; // of the variances, each divided by its degrees of freedom
} Sums;

typedef struct Level {
    int width, height, size; // blocks across and down; pixels per block
    Sums *sums;              // 3 per block
} Level;

static bool check(const NoisyPicture *a, const NoisyPicture *b, Error *e)
{
    if (a->mean->width != b->mean->width || a->mean->height != b->mean->height) {
        return error_set(e, ERROR_INPUT,
                         "pictures of %d x %d and %d x %d; they must be of one size",
                         a->mean->width, a->mean->height, b->mean->width, b->mean->height);
    }
    return (a->runs >= 2 && b->runs >= 2) ||
           error_set(e, ERROR_INPUT, "pictures of %d and %d runs; noise is known from 2 runs on",
                     a->runs, b->runs);
}

static void add_pixel(Sums *s, const NoisyPicture *a, const NoisyPicture *b, int64_t k)
{
    double va = (double)a->variance->pixel[k], vb = (double)b->variance->pixel[k];
    s->pixels += 1.0;
    s->a += (double)a->mean->pixel[k];
    s->b += (double)b->mean->pixel[k];
    s->variance_a += va;
    s->variance_b += vb;
    s->squares += va * va / (a->runs - 1) + vb * vb / (b->runs - 1);
}

static bool level_make(Level *level, int width, int height, int size, Error *e)
{
    *level = (Level){
        .width = (width + size - 1) / size, .height = (height + size - 1) / size, .size = size};
    level->sums = memory_alloc_zero((int64_t)level->width * level->height, 3 * sizeof(Sums), e);
    return level->sums;
}

static bool first_level(const NoisyPicture *a, const NoisyPicture *b, Level *level, Error *e)
{
    int width = a->mean->width, height = a->mean->height;
    if (!level_make(level, width, height, NOISE_BLOCK, e)) {
        return false;
    }
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            int64_t block = (int64_t)(y / NOISE_BLOCK) * level->width + x / NOISE_BLOCK;
            for (int c = 0; c < 3; c++) {
                add_pixel(&level->sums[3 * block + c], a, b, 3 * ((int64_t)y * width + x) + c);
            }
        }
    }
    return true;
}

// Merges blocks into blocks of twice the size.
static bool next_level(const Level *fine, int width, int height, Level *level, Error *e)
{
    if (!level_make(level, width, height, 2 * fine->size, e)) {
        return false;
    }
    for (int y = 0; y < fine->height; y++) {
        for (int x = 0; x < fine->width; x++) {
            const Sums *from = &fine->sums[3 * ((int64_t)y * fine->width + x)];
            Sums *to = &level->sums[3 * ((int64_t)(y / 2) * level->width + x / 2)];
            for (int c = 0; c < 3; c++) {
                to[c].pixels += from[c].pixels;
                to[c].a += from[c].a;
                to[c].b += from[c].b;
                to[c].variance_a += from[c].variance_a;
                to[c].variance_b += from[c].variance_b;
                to[c].squares += from[c].squares;
            }
        }
    }
    return true;
}

// Welch's test with the degrees of freedom of Welch and Satterthwaite: if a few pixels hold most of
// a block's variance, the degrees of freedom are few and the test is accordingly cautious.
static void judge(const Sums *s, NoiseBlock *block)
{
    double n = s->pixels;
    block->a = s->a / n;
    block->b = s->b / n;
    double difference = block->a - block->b;
    double indifferent = 0.5 * NOISE_INDIFFERENT * (fabs(block->a) + fabs(block->b));
    double noise = (s->variance_a + s->variance_b) / (n * n);
    double squares = s->squares / (n * n * n * n);
    double variance = noise + indifferent * indifferent;
    if (!isfinite(difference) || !isfinite(noise)) {
        bool same = block->a == block->b || (isnan(block->a) && isnan(block->b));
        block->p = same ? 1.0 : 0.0;
    } else if (difference == 0.0) {
        block->p = 1.0;
    } else if (squares > 0.0) {
        double freedom = variance * variance / squares;
        block->p = student_two_sided(difference / sqrt(variance), fmin(freedom, 1e9));
    } else {
        block->p = student_two_sided(difference / sqrt(variance), 1e9);
    }
    block->z = copysign(normal_of_two_sided(block->p), difference);
}

typedef struct Blocks {
    NoiseBlock *block; // owned
    int64_t count, capacity;
} Blocks;

static bool judge_level(const Level *level, Blocks *blocks, Error *e)
{
    int64_t count = (int64_t)level->width * level->height * 3;
    if (!memory_reserve(&blocks->block, &blocks->capacity, blocks->count + count,
                        sizeof *blocks->block, e)) {
        return false;
    }
    for (int64_t i = 0; i < count; i++) {
        int64_t place = i / 3;
        NoiseBlock *block = &blocks->block[blocks->count++];
        *block = (NoiseBlock){.x = (int)(place % level->width) * level->size,
                              .y = (int)(place / level->width) * level->size,
                              .size = level->size,
                              .channel = (int)(i % 3)};
        judge(&level->sums[i], block);
    }
    return true;
}

static bool judge_all(const NoisyPicture *a, const NoisyPicture *b, Blocks *blocks, Error *e)
{
    int width = a->mean->width, height = a->mean->height;
    Level level;
    bool done = first_level(a, b, &level, e) && judge_level(&level, blocks, e);
    while (done && (level.width > 1 || level.height > 1)) {
        Level coarse;
        done = next_level(&level, width, height, &coarse, e) && judge_level(&coarse, blocks, e);
        free(level.sums);
        level = coarse;
    }
    free(level.sums);
    return done;
}

static int by_probability(const void *x, const void *y)
{
    const NoiseBlock *a = x, *b = y;
    if (a->p != b->p) {
        return a->p < b->p ? -1 : 1;
    }
    double za = fabs(a->z), zb = fabs(b->z);
    return za > zb ? -1 : (za < zb ? 1 : a->size - b->size);
}

// Benjamini and Hochberg 1995: rejects all up to the last whose p is below alpha times its rank
// divided by their count.
static void step_up(const Blocks *sorted, double alpha, NoiseVerdict *verdict)
{
    *verdict = (NoiseVerdict){.tests = sorted->count, .p = 1.0, .worst = sorted->block[0]};
    for (int64_t i = 0; i < sorted->count; i++) {
        double p = sorted->block[i].p * (double)sorted->count / (double)(i + 1);
        verdict->p = fmin(verdict->p, p);
        verdict->rejected = p <= alpha ? i + 1 : verdict->rejected;
    }
}

// The first blocks in the list are the smallest, row by row.
static Image *map_of(const Blocks *blocks, int width, int height, Error *e)
{
    Image *map = image_new((width + NOISE_BLOCK - 1) / NOISE_BLOCK,
                           (height + NOISE_BLOCK - 1) / NOISE_BLOCK, 1, e);
    for (int64_t i = 0; map && i < 3 * (int64_t)map->width * map->height; i++) {
        float z = (float)blocks->block[i].z;
        if (fabsf(z) > fabsf(map->pixel[i / 3])) {
            map->pixel[i / 3] = z;
        }
    }
    return map;
}

bool noise_compare(const NoisyPicture *a, const NoisyPicture *b, double alpha,
                   NoiseVerdict *verdict, Image **z, Error *e)
{
    Blocks blocks = {0};
    bool done = check(a, b, e) && judge_all(a, b, &blocks, e);
    if (done && z) {
        *z = map_of(&blocks, a->mean->width, a->mean->height, e);
        done = *z;
    }
    if (done) {
        qsort(blocks.block, (size_t)blocks.count, sizeof *blocks.block, by_probability);
        step_up(&blocks, alpha, verdict);
    }
    free(blocks.block);
    return done;
}
