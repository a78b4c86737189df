// Diffusion-limited aggregation (Witten and Sander 1981), off lattice, in the plane and in space.
// Random walkers start far away, one at a time, and stick where they first touch the cluster.
#ifndef RAMIFY_GROW_AGGREGATE_DLA_H
#define RAMIFY_GROW_AGGREGATE_DLA_H

#include "base/run.h"
#include "outtree/out_tree.h"

typedef struct DlaParams {
    int dimension;    // 2: in the plane z = 0; 3: in space
    int64_t count;    // particles including the seed; 1 .. 2^31 - 1
    float diameter;   // m, distance between the centres of two particles in contact
    float least_step; // diameters: least step of walkers near the cluster. The walk is exact
                      // Brownian motion except for these steps, which stop at the first contact
    uint64_t seed;
} DlaParams;

DlaParams dla_params_default(void); // 2D, 10,000 particles of 1 m, least step 0.25, seed 1

// Grows the cluster about the origin as an out-tree: a particle's parent is the one it stuck to,
// its birth its index of arrival, its radius half the diameter. A walker jumps to a point on the
// largest empty sphere that a pyramid of grids finds in one query; one that leaves the launching
// sphere is returned by the exact distribution of its first return, or, in space, discarded with
// the exact probability of never returning. ERROR_INPUT for numbers out of range; ERROR_CANCELLED.
// The caller frees the tree.
OutTree *dla_grow(const DlaParams *params, const Run *run, Error *e);

// Fractal dimension: slope of log n over log of the radius of gyration of the first n particles,
// from a 64th of them to all. 0 below 128 particles.
double dla_dimension(const OutTree *cluster);

#endif
