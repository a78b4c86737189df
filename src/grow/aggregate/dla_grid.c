#include "grow/aggregate/dla_grid.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// diameters; the neighbouring cells contain every particle that a walker may touch in its next step
#define FINEST_CELL 3.0

static int64_t cells_of(const DlaGrid *grid, int level)
{
    int64_t side = grid->side[level];
    return grid->dimension == 2 ? side * side : side * side * side;
}

bool dla_grid_init(DlaGrid *grid, int dimension, double reach, int64_t capacity,
                   const double (*position)[3], Error *e)
{
    *grid = (DlaGrid){.dimension = dimension, .position = position};
    int64_t side = 8;
    while ((double)side * FINEST_CELL < 2.0 * reach + 4.0 * FINEST_CELL) {
        side *= 2;
    }
    grid->half = 0.5 * (double)side * FINEST_CELL;
    double cell = FINEST_CELL;
    bool made = true;
    for (; made && side >= 4 && grid->levels < DLA_MAX_LEVELS; side /= 2, cell *= 2.0) {
        int level = grid->levels++;
        grid->side[level] = side;
        grid->cell[level] = cell;
        grid->near[level] = memory_alloc_zero(cells_of(grid, level), 1, e);
        made = grid->near[level];
    }
    int64_t cells = cells_of(grid, 0);
    grid->head = made ? memory_alloc(cells, sizeof *grid->head, e) : NULL;
    grid->next = made ? memory_alloc(capacity, sizeof *grid->next, e) : NULL;
    if (!grid->head || !grid->next) {
        dla_grid_free(grid);
        return false;
    }
    memset(grid->head, 0xff, sizeof *grid->head * (size_t)cells);
    return true;
}

void dla_grid_free(DlaGrid *grid)
{
    for (int i = 0; i < grid->levels; i++) {
        free(grid->near[i]);
    }
    free(grid->head);
    free(grid->next);
    *grid = (DlaGrid){0};
}

// Cell of a point along each axis; in the plane there is one layer.
static void cell_of(const DlaGrid *grid, int level, const double p[3], int64_t c[3])
{
    for (int i = 0; i < 3; i++) {
        c[i] = i < grid->dimension ? (int64_t)((p[i] + grid->half) / grid->cell[level]) : 0;
    }
}

static int64_t index_of(const DlaGrid *grid, int level, int64_t x, int64_t y, int64_t z)
{
    int64_t side = grid->side[level];
    return (z * side + y) * side + x;
}

static bool layer_of(const DlaGrid *grid, int64_t side, int64_t z)
{
    return grid->dimension == 2 ? z == 0 : z >= 0 && z < side;
}

void dla_grid_add(DlaGrid *grid, int32_t particle)
{
    int64_t c[3];
    for (int level = 0; level < grid->levels; level++) {
        int64_t side = grid->side[level];
        cell_of(grid, level, grid->position[particle], c);
        for (int64_t z = c[2] - 1; z <= c[2] + 1; z++) {
            for (int64_t y = c[1] - 1; y <= c[1] + 1; y++) {
                for (int64_t x = c[0] - 1; x <= c[0] + 1; x++) {
                    if (layer_of(grid, side, z) && y >= 0 && y < side && x >= 0 && x < side) {
                        grid->near[level][index_of(grid, level, x, y, z)] = 1;
                    }
                }
            }
        }
    }
    cell_of(grid, 0, grid->position[particle], c);
    int64_t cell = index_of(grid, 0, c[0], c[1], c[2]);
    grid->next[particle] = grid->head[cell];
    grid->head[cell] = particle;
}

static bool is_near(const DlaGrid *grid, int level, const double p[3])
{
    int64_t c[3];
    cell_of(grid, level, p, c);
    return grid->near[level][index_of(grid, level, c[0], c[1], c[2])];
}

// From a point in a cell with empty neighbours: the distance to the nearest cell beyond them.
static double empty_distance(const DlaGrid *grid, int level, const double p[3])
{
    double cell = grid->cell[level], least = cell;
    for (int i = 0; i < grid->dimension; i++) {
        double at = (p[i] + grid->half) / cell;
        double in = at - (double)(int64_t)at;
        double wall = (in < 0.5 ? in : 1.0 - in) * cell;
        least = wall < least ? wall : least;
    }
    return cell + least;
}

static double squared_distance(const double a[3], const double b[3])
{
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

// Iterates over the cells about a point, row by row, and the particles in them.
typedef struct Neighbours {
    int64_t low[3], high[3];
    int64_t row, rows; // rows of cells along x
    int64_t x;         // of the current cell
} Neighbours;

static Neighbours neighbours_of(const DlaGrid *grid, const double p[3])
{
    int64_t c[3];
    cell_of(grid, 0, p, c);
    Neighbours n = {.rows = 1};
    for (int i = 0; i < 3; i++) {
        int64_t side = i < grid->dimension ? grid->side[0] : 1;
        n.low[i] = c[i] > 0 ? c[i] - 1 : 0;
        n.high[i] = c[i] < side - 1 ? c[i] + 1 : side - 1;
        n.rows *= i > 0 ? n.high[i] - n.low[i] + 1 : 1;
    }
    return n;
}

static int64_t row_start(const DlaGrid *grid, const Neighbours *n)
{
    int64_t rows = n->high[1] - n->low[1] + 1;
    return index_of(grid, 0, 0, n->low[1] + n->row % rows, n->low[2] + n->row / rows);
}

// The next particle, starting with this one, which may be -1: the end of a cell's list.
static int32_t next_particle(const DlaGrid *grid, Neighbours *n, int32_t particle)
{
    while (particle < 0) {
        if (++n->x > n->high[0]) {
            n->x = n->low[0];
            if (++n->row >= n->rows) {
                return -1;
            }
        }
        particle = grid->head[row_start(grid, n) + n->x];
    }
    return particle;
}

static int32_t first_particle(const DlaGrid *grid, Neighbours *n, const double p[3])
{
    *n = neighbours_of(grid, p);
    n->x = n->low[0];
    return next_particle(grid, n, grid->head[row_start(grid, n) + n->x]);
}

double dla_grid_distance(DlaGrid *grid, const double p[3], int32_t *nearest)
{
    *nearest = -1;
    int level = grid->level_hint;
    if (is_near(grid, level, p)) {
        do {
            level--;
        } while (level >= 0 && is_near(grid, level, p));
    } else {
        while (level + 1 < grid->levels && !is_near(grid, level + 1, p)) {
            level++;
        }
    }
    grid->level_hint = level > 0 ? level : 0;
    if (level >= 0) {
        return empty_distance(grid, level, p);
    }
    double least = grid->cell[0] * grid->cell[0];
    Neighbours around;
    for (int32_t i = first_particle(grid, &around, p); i >= 0;
         i = next_particle(grid, &around, grid->next[i])) {
        double d2 = squared_distance(p, grid->position[i]);
        if (d2 < least || (d2 == least && i < *nearest)) {
            least = d2;
            *nearest = i;
        }
    }
    return sqrt(least);
}

int32_t dla_grid_contact(const DlaGrid *grid, const double p[3], const double direction[3],
                         double length, double *touch)
{
    int32_t first = -1;
    double nearest = length;
    Neighbours around;
    for (int32_t i = first_particle(grid, &around, p); i >= 0;
         i = next_particle(grid, &around, grid->next[i])) {
        // solve |p + t d - q| = 1 for the smaller t
        double b = 0.0, c = squared_distance(p, grid->position[i]) - 1.0;
        for (int k = 0; k < 3; k++) {
            b += (p[k] - grid->position[i][k]) * direction[k];
        }
        double root = b * b - c;
        if (b >= 0.0 || root < 0.0) {
            continue; // moving away, or already past
        }
        double t = -b - sqrt(root);
        t = t > 0.0 ? t : 0.0;
        if (t < nearest || (t == nearest && first >= 0 && i < first)) {
            nearest = t;
            first = i;
        }
    }
    *touch = nearest;
    return first;
}
