// Diffusion-limited aggregation (Witten and Sander 1981), off lattice, in the plane and in space:
// what the papers compare their method with. Random walkers come from far away, one at a time, and
// stick where they first touch the cluster.
#ifndef RAMIFY_GROW_AGGREGATE_DLA_H
#define RAMIFY_GROW_AGGREGATE_DLA_H

#include "base/run.h"
#include "outtree/out_tree.h"

typedef struct DlaParams {
    int dimension;    // 2: in the plane z = 0; 3: in space
    int64_t count;    // particles, the seed too; 1 .. 2^31 - 1
    float diameter;   // m, of a particle: two that touch have their centres this far apart
    float least_step; // diameters: walkers near the cluster never step by less. The walk is exact
                      // Brownian motion but for these steps, which stop at the first contact
    uint64_t seed;
} DlaParams;

DlaParams dla_params_default(void); // 2D, 10,000 particles of 1 m, least step 0.25, seed 1

// The cluster about the origin as an out-tree: a particle's parent is the one it stuck to, its
// birth its place in the order of arrival. Radii are half the diameter. Walkers jump to a point on
// a sphere that holds no particle, as large as a pyramid of grids shows at once; one that leaves
// the launching sphere comes back to it by the exact distribution of its first return, or, in
// space, never with the exact probability of that. ERROR_INPUT for numbers out of range;
// ERROR_CANCELLED.
OutTree *dla_grow(const DlaParams *params, const Run *run, Error *e);

// Fractal dimension: the slope of log n over log of the radius of gyration of the first n
// particles, from a 64th of them to all. 0 below 128 particles.
double dla_dimension(const OutTree *cluster);

#endif
