// Sky light among leaves, on a voxel grid: leaves are a medium of black, randomly oriented flakes,
// and light from each of 25 parts of an overcast sky is carried through the grid layer by layer.
// What the leaves of all cells catch together never exceeds what enters the grid.
#ifndef RAMIFY_GROW_LIGHT_SHADE_GRID_H
#define RAMIFY_GROW_LIGHT_SHADE_GRID_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct ShadeGrid {
    int size[3]; // cells along x, y, z
    float cell;  // edge
    Vec3 low;    // corner of cell 0
    int64_t count;
    float *leaf;      // per cell: area of leaves across the light
    bool *taken;      // per cell: light does not pass
    float *light;     // per cell: mean light on its leaves, 1 = under the open sky
    float *bright[3]; // per cell: sum of the directions to the sky, by the light from there
} ShadeGrid;

// A grid over the box, without leaves. If it would have more than `most` cells, cells are larger
// than `cell`. Free with shade_grid_free.
ShadeGrid *shade_grid_new(Aabb box, float cell, int64_t most, Error *e);
void shade_grid_free(ShadeGrid *grid); // NULL is fine

// Adds leaves of this area (across the light) at p, shared among the eight nearest cells.
void shade_grid_add_leaves(ShadeGrid *grid, Vec3 p, float area);

// The same for many threads and in any order: the leaves are counted in `sum`, one integer a cell,
// 0 at first, which shade_grid_set_leaves then makes the grid's leaves.
void shade_grid_count_leaves(const ShadeGrid *grid, Vec3 p, float area, int64_t *sum);
void shade_grid_set_leaves(ShadeGrid *grid, const int64_t *sum);

// Computes light and bright. The same bits for any number of threads.
bool shade_grid_solve(ShadeGrid *grid, int threads, Error *e);

// Light per area (0..1) on leaves at p: times their area it is what they catch.
float shade_grid_light(const ShadeGrid *grid, Vec3 p);

// The mean direction to the light at p, not unit: shorter in deep shade.
Vec3 shade_grid_brightest(const ShadeGrid *grid, Vec3 p);

// Light that enters the grid through its top and sides, in the unit of light times area.
double shade_grid_incoming(const ShadeGrid *grid);

#endif
