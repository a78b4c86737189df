// Spatial index of a growing cluster: a grid of particle lists, and above it a pyramid of coarser
// grids that mark whether a cell and its neighbours are empty. One lookup per level bounds the
// distance to the cluster from below.
#ifndef RAMIFY_GROW_AGGREGATE_DLA_GRID_H
#define RAMIFY_GROW_AGGREGATE_DLA_GRID_H

#include "base/error.h"

#include <stdbool.h>
#include <stdint.h>

enum { DLA_MAX_LEVELS = 24 };

// Lengths in particle diameters. The grid is a cube (square) centred at the origin.
typedef struct DlaGrid {
    int dimension;
    double half; // half its side
    int levels;
    int64_t side[DLA_MAX_LEVELS];  // cells per side, halved from level to level
    double cell[DLA_MAX_LEVELS];   // cell width
    uint8_t *near[DLA_MAX_LEVELS]; // per cell: whether it or a neighbour holds a particle
    int32_t *head;                 // per cell of level 0: its latest particle, or -1
    int32_t *next;                 // per particle: the previous one in its cell, or -1
    const double (*position)[3];   // of the particles; borrowed
    int level_hint;                // level of the last lookup
} DlaGrid;

// Covers particles within `reach` of the origin; capacity: largest number of particles.
bool dla_grid_init(DlaGrid *grid, int dimension, double reach, int64_t capacity,
                   const double (*position)[3], Error *e);
void dla_grid_free(DlaGrid *grid);

void dla_grid_add(DlaGrid *grid, int32_t particle);

// Distance from p, inside the grid, below which there is no particle's centre. *nearest is set to
// the nearest particle if the distance is exact, to -1 if it is a bound.
double dla_grid_distance(DlaGrid *grid, const double p[3], int32_t *nearest);

// The first particle that a walker touches (centres 1 apart) when it moves from p by `length` along
// the unit direction; -1 if none. *touch: distance until contact. length is at most 1.
int32_t dla_grid_contact(const DlaGrid *grid, const double p[3], const double direction[3],
                         double length, double *touch);

#endif
