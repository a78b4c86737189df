// Jitter: fractional Brownian motion added to an out-tree (Tanaka eq. (14)), so that branches
// wander at every scale. Each chain is displaced perpendicular to its direction by a bridge of the
// process.
#ifndef RAMIFY_OUTTREE_JITTER_H
#define RAMIFY_OUTTREE_JITTER_H

#include "base/run.h"
#include "outtree/out_tree.h"

// Moves p to the nearest point of the surface that growth stays on and sets the unit normal there.
typedef void SurfaceProject(const void *surface, Vec3 *p, Vec3 *normal);

typedef struct JitterParams {
    float hurst;     // Hurst exponent H, 0 < H < 1: the smaller, the rougher
    float amplitude; // m: standard deviation of the unpinned process per perpendicular axis after
                     // `reference`; after a distance d it is amplitude (d / reference)^H
    float reference; // m
    bool pin_forks;  // false: a chain is pinned at its two ends, and branches move along with their
                     // forks; true: pinned at every fork too, so forks and tips stay
    uint64_t seed;
    SurfaceProject *project; // NULL in space; on a surface, nodes move along it, across their
                             // chains
    float stride; // m: how far a node moves before it is projected again; at most the distance over
                  // which project is reliable
    const void *surface; // passed to project
} JitterParams;

JitterParams
jitter_params_default(void); // H 0.7, amplitude 0, reference and stride 1 m, unpinned, in space

// Displaces the tree's nodes in place; roots and the tips of their chains stay. The process is
// sampled as many times as a chain has nodes, uniformly by arc length, and interpolated linearly:
// evenly spaced nodes (out_tree_resample) get it exactly. Draws are keyed by node ids. ERROR_INPUT
// for a Hurst exponent out of range or invalid lengths; ERROR_CANCELLED.
bool out_tree_jitter(OutTree *tree, const JitterParams *params, const Run *run, Error *e);

#endif
