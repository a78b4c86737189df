// Poisson-disk points by dart throwing (Cook 1986): a dart is accepted when no earlier one is
// nearer than the least distance. Conflicts with earlier rounds are tested in parallel; the
// remaining darts are then tried in order, so the result equals that of throwing one by one.
#include "base/exact_math.h"
#include "base/memory.h"
#include "base/random.h"
#include "shape/scatter.h"

#include <math.h>
#include <stdlib.h>

// Saturation density: accepted darts per cube (square) of the least distance's side after
// infinitely many throws: 0.384 of space in balls, 0.547 of a plane in discs of that diameter.
#define JAMMED_VOLUME 0.7334
#define JAMMED_SURFACE 0.6966
// Share of the saturation density at which throwing stops: 13 darts per point in space and 10 on a
// plane. 0.8 in space would take 46.
#define FULLNESS_VOLUME 0.70
#define FULLNESS_SURFACE 0.80
#define DARTS_PER_POINT 40 // then give up: the region holds fewer points than estimated

// An accepted dart.
typedef struct Dart {
    Vec3 position;
    int32_t next; // index in DartGrid.spilled of an earlier dart of the same cell; or one of these
} Dart;

enum { DART_LAST = -1, DART_NONE = -2 };

// Hash table of darts, with cells as wide as the least distance; the newest dart of each cell is
// stored in the table itself. Cells of a block of 4 x 4 x 4 are adjacent in memory, because
// neighbours are looked up together and lookups are bound by memory.
typedef struct DartGrid {
    Dart *slot;
    Dart *spilled;
    int64_t spilled_count, spilled_capacity;
    uint64_t block_mask;
    float distance2, inverse_cell;
    Vec3 origin;
} DartGrid;

static uint64_t slot_of(const DartGrid *g, int32_t x, int32_t y, int32_t z)
{
    uint64_t key = random_mix((uint64_t)(uint32_t)(x >> 2) * 0x9e3779b97f4a7c15ull ^
                              (uint64_t)(uint32_t)(y >> 2) << 32 ^ (uint64_t)(uint32_t)(z >> 2));
    uint64_t cell = (uint64_t)((x & 3) << 4 | (y & 3) << 2 | (z & 3));
    return (key & g->block_mask) << 6 | cell;
}

static bool grid_new(DartGrid *g, Vec3 origin, float distance, int64_t expected, Error *e)
{
    uint64_t blocks = 4;
    while (blocks * 64 < (uint64_t)expected * 2) {
        blocks *= 2;
    }
    *g = (DartGrid){.block_mask = blocks - 1,
                    .distance2 = distance * distance,
                    .inverse_cell = 1.0f / distance,
                    .origin = origin};
    g->slot = memory_alloc((int64_t)blocks * 64, sizeof *g->slot, e);
    if (!g->slot) {
        return false;
    }
    for (uint64_t i = 0; i < blocks * 64; i++) {
        g->slot[i].next = DART_NONE;
    }
    return true;
}

static void grid_free(DartGrid *g)
{
    free(g->slot);
    free(g->spilled);
}

static void cell_of(const DartGrid *g, Vec3 p, int32_t c[3])
{
    Vec3 local = vec3_scale(vec3_sub(p, g->origin), g->inverse_cell);
    c[0] = (int32_t)floorf(local.x);
    c[1] = (int32_t)floorf(local.y);
    c[2] = (int32_t)floorf(local.z);
}

static bool near_cell(const DartGrid *g, const Dart *dart, Vec3 p)
{
    if (dart->next == DART_NONE) {
        return false;
    }
    for (;;) {
        Vec3 d = vec3_sub(dart->position, p);
        if (vec3_dot(d, d) < g->distance2) {
            return true;
        }
        if (dart->next == DART_LAST) {
            return false;
        }
        dart = &g->spilled[dart->next];
    }
}

// Whether an accepted dart lies too near to p.
static bool grid_hits(const DartGrid *g, Vec3 p)
{
    int32_t c[3];
    cell_of(g, p, c);
    for (int n = 0; n < 27; n++) {
        // start with the dart's own cell
        int k = (n + 13) % 27;
        uint64_t at = slot_of(g, c[0] + k / 9 - 1, c[1] + k / 3 % 3 - 1, c[2] + k % 3 - 1);
        if (near_cell(g, &g->slot[at], p)) {
            return true;
        }
    }
    return false;
}

static bool grid_add(DartGrid *g, Vec3 p, Error *e)
{
    int32_t c[3], next = DART_LAST;
    cell_of(g, p, c);
    Dart *slot = &g->slot[slot_of(g, c[0], c[1], c[2])];
    if (slot->next != DART_NONE) {
        if (g->spilled_count == INT32_MAX) {
            return error_set(e, ERROR_INPUT, "too many points; use fewer");
        }
        if (!memory_reserve(&g->spilled, &g->spilled_capacity, g->spilled_count + 1,
                            sizeof *g->spilled, e)) {
            return false;
        }
        next = (int32_t)g->spilled_count++;
        g->spilled[next] = *slot;
    }
    *slot = (Dart){p, next};
    return true;
}

// The least distance at which `base` points fill the region to the share wanted.
static float least_distance(const PointSet *points, double base)
{
    double share = points->measure / base;
    return points->dimension == 3
               ? (float)exact_exp(exact_log(JAMMED_VOLUME * FULLNESS_VOLUME * share) / 3.0)
               : (float)sqrt(JAMMED_SURFACE * FULLNESS_SURFACE * share);
}

// Throws draws first .. first + size - 1 and adds the accepted ones that are kept.
static bool throw_round(const Scatter *s, DartGrid *g, uint64_t first, int64_t size, Draw *draws,
                        PointSet *points, const Run *run, Error *e)
{
#pragma omp parallel for schedule(dynamic, 1024) num_threads(run->threads)
    for (int64_t i = 0; i < size; i++) {
        draws[i] = scatter_draw(s, first + (uint64_t)i);
        draws[i].inside = draws[i].inside && !grid_hits(g, draws[i].position);
    }
    for (int64_t i = 0; i < size && points->count < s->params->count; i++) {
        const Draw *draw = &draws[i];
        if (!draw->inside || grid_hits(g, draw->position)) {
            continue;
        }
        if (!grid_add(g, draw->position, e) ||
            (draw->kept && !points_add(points, draw->position, draw->normal, draw->id, e))) {
            return false;
        }
    }
    return true;
}

// Share of the draws that lie in the region, and on the side of its surface that is wanted.
static double inside_share(const Scatter *s)
{
    const float(*m)[4] = s->frame.m;
    Vec3 x = vec3(m[0][0], m[1][0], m[2][0]), y = vec3(m[0][1], m[1][1], m[2][1]);
    Vec3 z = vec3(m[0][2], m[1][2], m[2][2]);
    double box = (double)fabsf(vec3_dot(x, vec3_cross(y, z)));
    return s->params->place == SCATTER_SURFACE ? s->seen : envelope_volume(s->envelope) / box;
}

bool scatter_poisson(const Scatter *s, PointSet *points, const Run *run, Error *e)
{
    double wanted = (double)s->params->count, base = wanted / s->mean_weight;
    double share = inside_share(s), limit = (DARTS_PER_POINT * base + 10000.0) / share;
    DartGrid grid;
    if (!grid_new(&grid, s->lowest_corner, least_distance(points, base), (int64_t)base, e)) {
        return false;
    }
    Draw *draws = memory_alloc(SCATTER_ROUND, sizeof *draws, e);
    bool done = draws;
    double drawn = 0.0;
    int64_t size = (int64_t)fmin(fmax(wanted / share, 1024.0), (double)SCATTER_ROUND);
    while (done && points->count < s->params->count && drawn < limit) {
        done = throw_round(s, &grid, (uint64_t)drawn, size, draws, points, run, e);
        drawn += (double)size;
        if (done && run_is_cancelled(run)) {
            done = run_cancel_error(e);
        }
        run_progress(run, "scatter", (double)points->count / wanted);
    }
    free(draws);
    grid_free(&grid);
    return done && (points->count > 0 || scatter_empty_error(s, (int64_t)drawn, e));
}
