#include "land/tile_detail.h"

#include "base/memory.h"
#include "base/noise.h"
#include "base/vec.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- samples between samples

static float between(float a, float b, float c, float d)
{
    return 0.0625f * (9.0f * (b + c) - (a + d));
}

// A fine row or column of the coarse samples `from`, `stride` apart.
static void refine_line(float *to, int count, int64_t first, const float *from, int64_t from_first,
                        int64_t to_stride, int64_t stride)
{
    for (int i = 0; i < count; i++) {
        int64_t index = first + i;
        const float *at = from + (tile_half(index) - from_first) * stride;
        to[i * to_stride] =
            (index & 1) == 0 ? at[0] : between(at[-stride], at[0], at[stride], at[2 * stride]);
    }
}

bool tile_refine(TileWindow *fine, const TileWindow *coarse, const Run *run, Error *e)
{
    int64_t wide = fine->columns;
    float *rows = memory_alloc(wide * coarse->rows, sizeof *rows, e);
    fine->height = rows ? memory_alloc(wide * fine->rows, sizeof(float), e) : NULL;
    if (!fine->height) {
        free(rows);
        return false;
    }
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int row = 0; row < coarse->rows; row++) {
        refine_line(rows + row * wide, fine->columns, fine->x,
                    coarse->height + (int64_t)row * coarse->columns, coarse->x, 1, 1);
    }
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int column = 0; column < fine->columns; column++) {
        refine_line(fine->height + column, fine->rows, fine->z, rows + column, coarse->z, wide,
                    wide);
    }
    free(rows);
    return true;
}

// ---- roughness

// The index of the sample that a mirrored or repeated one stands for.
static int64_t inside(int64_t index, const TileDetail *detail)
{
    return tile_folded(index, detail->period, detail->periodic);
}

static float steepness(const float *h, int64_t columns, float cell)
{
    float dx = h[1] - h[-1], dz = h[columns] - h[-columns];
    return 0.5f * sqrtf(dx * dx + dz * dz) / cell;
}

// Waves of about four cells, as high as the slope allows: flat floors stay flat.
static bool add_noise(TileWindow *window, const TileDetail *detail, const Run *run, Error *e)
{
    const float wavelength = 5.0f, share = 0.11f, steepest = 1.2f;
    int64_t columns = window->columns, count = columns * window->rows;
    float *rough = memory_alloc(count, sizeof *rough, e);
    if (!rough) {
        return false;
    }
    memcpy(rough, window->height, sizeof *rough * (size_t)count);
#pragma omp parallel for schedule(static) num_threads(run->threads)
    for (int row = 1; row < window->rows - 1; row++) {
        for (int64_t column = 1; column < columns - 1; column++) {
            int64_t i = row * columns + column;
            float x = (float)inside(window->x + column, detail) / wavelength;
            float z = (float)inside(window->z + row, detail) / wavelength;
            float slope = fminf(steepness(window->height + i, columns, detail->cell), steepest);
            rough[i] += detail->strength * share * wavelength * detail->cell * slope *
                        noise_plane(x, z, detail->seed);
        }
    }
    free(window->height);
    window->height = rough;
    return true;
}

// ---- gullies

// Water of a shower runs STEPS samples far before it sinks in; ROUNDS showers.
enum { STEPS = 16, ROUNDS = 3, NEIGHBOURS = 8 };

static const int AROUND[NEIGHBOURS][2] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0},
                                          {1, 0},   {-1, 1}, {0, 1},  {1, 1}};

// Each neighbour's shares lie together, so that a row of samples is summed by vectors.
typedef struct Shower {
    const TileWindow *window;
    int64_t step[NEIGHBOURS];     // to the neighbours, in samples
    float away[NEIGHBOURS];       // in cells
    float *share[NEIGHBOURS];     // of each sample: what this neighbour gets of its water, 0..1
    float *water, *next, *height; // cells that drain through a sample; heights to be
} Shower;

static void shower_clear(Shower *s)
{
    free(s->share[0]);
    free(s->water);
    free(s->next);
    free(s->height);
}

static bool shower_init(Shower *s, const TileWindow *window, Error *e)
{
    int64_t count = (int64_t)window->columns * window->rows;
    *s = (Shower){.window = window,
                  .share[0] = memory_alloc_zero(count * NEIGHBOURS, sizeof(float), e),
                  .water = memory_alloc(count, sizeof *s->water, e),
                  .next = memory_alloc(count, sizeof *s->next, e),
                  .height = memory_alloc(count, sizeof *s->height, e)};
    if (!s->share[0] || !s->water || !s->next || !s->height) {
        return false;
    }
    for (int k = 0; k < NEIGHBOURS; k++) {
        s->share[k] = s->share[0] + k * count;
        s->step[k] = AROUND[k][1] * (int64_t)window->columns + AROUND[k][0];
        s->away[k] = AROUND[k][0] != 0 && AROUND[k][1] != 0 ? 1.41421356f : 1.0f;
    }
    for (int64_t i = 0; i < count; i++) {
        s->water[i] = s->next[i] = 1.0f;
    }
    memcpy(s->height, window->height, sizeof *s->height * (size_t)count);
    return true;
}

// Water is shared among lower neighbours by the squares of the slopes (Freeman 1991, rounder).
// `next` holds the sum of the squares meanwhile.
static void share_water(const Shower *s, int64_t begin, int64_t end)
{
    const float *h = s->window->height;
    float *restrict sum = s->next;
    for (int64_t i = begin; i < end; i++) {
        sum[i] = 0.0f;
    }
    for (int k = 0; k < NEIGHBOURS; k++) {
        float *restrict share = s->share[k];
        const float *near = h + s->step[k], away = s->away[k];
        for (int64_t i = begin; i < end; i++) {
            float fall = (h[i] - near[i]) / away;
            share[i] = fall > 0.0f ? fall * fall : 0.0f;
            sum[i] += share[i];
        }
    }
    for (int k = 0; k < NEIGHBOURS; k++) {
        float *restrict share = s->share[k];
        for (int64_t i = begin; i < end; i++) {
            share[i] = sum[i] > 0.0f ? share[i] / sum[i] : 0.0f;
        }
    }
}

// What two neighbours, k and the next, give. The loop over samples has both, which saves half of
// the memory's work.
static void gather_from(const Shower *s, int k, int64_t begin, int64_t end)
{
    const float *share = s->share[NEIGHBOURS - 1 - k] + s->step[k], *water = s->water + s->step[k];
    const float *other = s->share[NEIGHBOURS - 2 - k] + s->step[k + 1];
    const float *beside = s->water + s->step[k + 1];
    float *restrict next = s->next;
    for (int64_t i = begin; i < end; i++) {
        next[i] = next[i] + share[i] * water[i] + other[i] * beside[i];
    }
}

static void gather_water(const Shower *s, int64_t begin, int64_t end)
{
    for (int64_t i = begin; i < end; i++) {
        s->next[i] = 1.0f;
    }
    for (int k = 0; k < NEIGHBOURS; k += 2) {
        gather_from(s, k, begin, end);
    }
}

// Cuts where more water gathers than on a plane slope, never below the lowest neighbour, and lets
// the ground creep a little.
static float cut(const Shower *s, int64_t i, float strength)
{
    const float *h = s->window->height + i;
    float lowest = h[0], fall = 0.0f, sides = 0.0f;
    for (int k = 0; k < NEIGHBOURS; k++) {
        float near = h[s->step[k]], steep = (h[0] - near) / s->away[k];
        lowest = near < lowest ? near : lowest;
        fall = steep > fall ? steep : fall;
        sides += s->away[k] == 1.0f ? near : 0.0f;
    }
    float gathered = sqrtf(s->water[i] / (float)STEPS) - 1.0f;
    float depth = gathered > 0.0f ? 0.14f * strength * gathered * fall : 0.0f;
    float creep = 0.06f * strength * (0.25f * sides - h[0]);
    float deep = h[0] - depth;
    return (deep > lowest ? deep : lowest) + creep;
}

static void cut_gullies(const Shower *s, int64_t begin, int64_t end, float strength)
{
    for (int64_t i = begin; i < end; i++) {
        s->height[i] = cut(s, i, strength);
    }
}

typedef enum Pass { PASS_SHARE, PASS_GATHER, PASS_CUT } Pass;

// One pass over the samples inside the window's border.
static void walk(const Shower *s, Pass pass, float strength, int threads)
{
    int64_t columns = s->window->columns;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int row = 1; row < s->window->rows - 1; row++) {
        int64_t begin = row * columns + 1, end = (row + 1) * columns - 1;
        switch (pass) {
        case PASS_SHARE:
            share_water(s, begin, end);
            break;
        case PASS_GATHER:
            gather_water(s, begin, end);
            break;
        case PASS_CUT:
            cut_gullies(s, begin, end, strength);
            break;
        }
    }
}

static bool rain(TileWindow *window, float strength, const Run *run, Error *e)
{
    Shower s;
    if (!shower_init(&s, window, e)) {
        shower_clear(&s);
        return false;
    }
    walk(&s, PASS_SHARE, 0.0f, run->threads);
    for (int step = 0; step < STEPS; step++) {
        walk(&s, PASS_GATHER, 0.0f, run->threads);
        float *swap = s.water;
        s.water = s.next;
        s.next = swap;
    }
    walk(&s, PASS_CUT, strength, run->threads);
    free(window->height);
    window->height = s.height;
    s.height = NULL;
    shower_clear(&s);
    return true;
}

// The noise looks one sample far; a shower at what water of STEPS samples knows, which is one more,
// and at the neighbours that it cuts toward.
int tile_detail_reach(void)
{
    return 1 + ROUNDS * (STEPS + 2);
}

bool tile_roughen(TileWindow *window, const TileDetail *detail, const Run *run, Error *e)
{
    bool done = add_noise(window, detail, run, e);
    for (int round = 0; done && round < ROUNDS; round++) {
        done = rain(window, detail->strength, run, e);
    }
    return done;
}
