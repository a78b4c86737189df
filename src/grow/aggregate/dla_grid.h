// Where the particles of a growing cluster are: a grid with the particles of each cell, and above
// it a pyramid of coarser grids that say whether a cell and its neighbours are empty. One look-up a
// level bounds the distance to the cluster from below.
#ifndef RAMIFY_GROW_AGGREGATE_DLA_GRID_H
#define RAMIFY_GROW_AGGREGATE_DLA_GRID_H

#include "base/error.h"

#include <stdbool.h>
#include <stdint.h>

enum { DLA_MOST_LEVELS = 24 };

// Lengths are in particle diameters. The grid is a cube (square) about the origin.
typedef struct DlaGrid {
    int dimension;
    double half; // half of its side
    int levels;
    int64_t side[DLA_MOST_LEVELS];  // cells a side, halved from level to level
    double cell[DLA_MOST_LEVELS];   // side of a cell
    uint8_t *near[DLA_MOST_LEVELS]; // per cell: is there a particle in it or beside it?
    int32_t *head;                  // per cell of level 0: its last particle, -1
    int32_t *next;                  // per particle: the one before it in its cell, -1
    const double (*position)[3];    // of the particles; borrowed
    int level_hint;                 // of the last look-up
} DlaGrid;

// Holds particles within `reach` of the origin; capacity: most particles.
bool dla_grid_init(DlaGrid *grid, int dimension, double reach, int64_t capacity,
                   const double (*position)[3], Error *e);
void dla_grid_free(DlaGrid *grid);

void dla_grid_add(DlaGrid *grid, int32_t particle);

// A distance from p, inside the grid, that no particle's centre is nearer than. *nearest is set to
// the nearest particle when the distance is exact, to -1 when it is a bound.
double dla_grid_distance(DlaGrid *grid, const double p[3], int32_t *nearest);

// The first particle that a walker touches (centres 1 apart) on its way from p by `length` along
// the unit direction; -1 if none. *touch: how far along. length is at most 1.
int32_t dla_grid_contact(const DlaGrid *grid, const double p[3], const double direction[3],
                         double length, double *touch);

#endif
