// Creeks of a delta's marsh (land/creeks.h): from channels and the sea they branch into the land,
// over mud flats and through ponds, seldom across levees, which they pass in few places.
#include "base/memory.h"
#include "base/noise.h"
#include "base/random.h"
#include "objects/terrain/delta.h"

#include <math.h>
#include <stdlib.h>

enum { FINE = 4 }; // samples a cell of the model

typedef struct Marsh {
    const DeltaLand *land;
    uint64_t seed;
    int columns, rows;
    uint8_t *ground; // CreekGround
    float *cost;
    int32_t *stack;
} Marsh;

// m of water over a sample, of the river's depth.
static float depth_of(const Marsh *m, float u, float v)
{
    const DeltaLand *land = m->land;
    return (delta_land_at(land, land->level, u, v) - delta_land_at(land, land->ground, u, v)) /
           (float)land->model->depth;
}

// Peat and mud are tougher in some places than in others.
static float cost_at(const Marsh *m, int64_t i, float u, float v)
{
    float levee = delta_land_at(m->land, m->land->levee, u, v);
    float patch = noise_plane_fractal(u / 1.6f, v / 1.6f, 4, random_key(m->seed, 1));
    float own = random_unit(random_key(m->seed, (uint64_t)i + 16));
    float tough = fmaxf(1.0f + 1.7f * patch, 0.12f);
    return (0.15f + 1.6f * own * own) * tough * tough * (1.0f + 9.0f * levee * levee);
}

static void lay_row(const Marsh *m, int row)
{
    const float deep = 0.16f;
    const Delta *d = m->land->model;
    for (int column = 0; column < m->columns; column++) {
        int64_t i = (int64_t)row * m->columns + column;
        float u = (float)column / FINE, v = (float)row / FINE;
        int c = column / FINE, r = row / FINE;
        c = c < d->columns ? c : d->columns - 1;
        r = r < d->rows ? r : d->rows - 1;
        DeltaCell kind = (DeltaCell)d->kind[(int64_t)r * d->columns + c];
        bool deep_here = kind == DELTA_TRUNK || kind == DELTA_EDGE || depth_of(m, u, v) > deep;
        m->ground[i] = deep_here ? CREEK_WATER : kind == DELTA_PLAIN ? CREEK_NONE : CREEK_MARSH;
        m->cost[i] = cost_at(m, i, u, v);
    }
}

// Ponds, which no water joins to the sea, are drained, too.
static void open_ponds(Marsh *m)
{
    enum { SEEN = 8 };
    int64_t found = 0, count = (int64_t)m->columns * m->rows;
    for (int64_t i = 0; i < count; i++) {
        int64_t column = i % m->columns, row = i / m->columns;
        bool rim = column == 0 || row == 0 || column == m->columns - 1 || row == m->rows - 1;
        if (rim && m->ground[i] == CREEK_WATER) {
            m->ground[i] |= SEEN;
            m->stack[found++] = (int32_t)i;
        }
    }
    for (int64_t k = 0; k < found; k++) {
        int64_t column = m->stack[k] % m->columns, row = m->stack[k] / m->columns;
        for (int n = 0; n < 4; n++) {
            int64_t c = column + (n == 0) - (n == 1), r = row + (n == 2) - (n == 3);
            int64_t i = r * m->columns + c;
            if (c >= 0 && r >= 0 && c < m->columns && r < m->rows && m->ground[i] == CREEK_WATER) {
                m->ground[i] |= SEEN;
                m->stack[found++] = (int32_t)i;
            }
        }
    }
    for (int64_t i = 0; i < count; i++) {
        bool pond = m->ground[i] == CREEK_WATER;
        m->ground[i] = m->ground[i] & SEEN ? CREEK_WATER : pond ? CREEK_MARSH : m->ground[i];
    }
}

bool delta_creeks_grow(DeltaLand *land, float density, uint64_t seed, const Run *run, Error *e)
{
    const float spread =
        0.62f; // cells: the root of the area that the smallest drains, at density 1
    int columns = land->model->columns * FINE + 1, rows = land->model->rows * FINE + 1;
    int64_t count = (int64_t)columns * rows;
    Marsh m = {land,
               seed,
               columns,
               rows,
               memory_alloc(count, sizeof *m.ground, e),
               memory_alloc(count, sizeof *m.cost, e),
               memory_alloc(count, sizeof *m.stack, e)};
    if (m.ground && m.cost && m.stack) {
#pragma omp parallel for schedule(dynamic, 4) num_threads(run->threads)
        for (int row = 0; row < rows; row++) {
            lay_row(&m, row);
        }
        open_ponds(&m);
        float root = FINE * spread / density;
        CreekPlain plain = {.columns = columns,
                            .rows = rows,
                            .ground = m.ground,
                            .cost = m.cost,
                            .least = root * root,
                            .width = 0.12f * FINE,
                            .most = 1.1f * FINE};
        land->creeks = creeks_grow(&plain, e);
    }
    free(m.ground);
    free(m.cost);
    free(m.stack);
    return land->creeks;
}

// A creek's bed is flat between steep banks, which go on to the ground beside it. The smallest are
// gullies that the ebb leaves dry.
float delta_creeks_cut(const DeltaLand *land, Vec2 at, float ground, float level)
{
    const float steep = 0.32f, deepest = 0.5f; // depth by half-width; of the river's depth
    float half, depth = (float)land->model->depth;
    float side = creeks_beside(land->creeks, (Vec2){FINE * at.x, FINE * at.y}, &half);
    if (side > CREEK_REACH) {
        return ground;
    }
    float width = half / FINE * (float)land->model->cell; // m, half of it
    float deep = fminf(steep * width, deepest * depth);
    float dry = 0.10f * depth * smoothstepf(0.13f, 0.05f, half / FINE);
    float squared = side * side, bank = 0.4f * squared + 0.6f * squared * squared - 1.0f;
    float bed = level + dry + deep * bank;
    return fminf(ground, bed);
}
