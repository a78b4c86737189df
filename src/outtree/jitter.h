// Jitter: fractional Brownian motion laid over an out-tree (Tanaka et al., eq. (14)), so that ways
// wander at every scale. Each chain is displaced across its direction by a bridge of the process.
#ifndef RAMIFY_OUTTREE_JITTER_H
#define RAMIFY_OUTTREE_JITTER_H

#include "base/run.h"
#include "outtree/out_tree.h"

// Moves p to the nearest point of the surface that growth stays on and tells the unit normal there.
typedef void SurfaceProject(const void *surface, Vec3 *p, Vec3 *normal);

typedef struct JitterParams {
    float hurst;     // H, 0 < H < 1: the rougher, the smaller
    float amplitude; // m: standard deviation of the unbound process, per direction across, after
                     // `reference`; over another distance d it is amplitude (d / reference)^H
    float reference; // m
    bool pin_forks;  // false: a chain is pinned at its two ends and what leaves it is carried along
                     // with its fork; true: pinned at every fork too, no fork and no tip moves
    uint64_t seed;
    SurfaceProject *project; // NULL in space. On a surface nodes walk along it, across their chains
    float stride; // m: how far a node walks before it is put back on the surface: not further than
                  // project can be trusted to find it
    const void *surface; // handed to project
} JitterParams;

JitterParams
jitter_params_default(void); // H 0.7, amplitude 0, reference and stride 1 m, unpinned, in space

// Displaces the tree's nodes in place; roots stay, and so do their chains' tips. The process
// is drawn as many times as there are nodes, evenly along a chain, and runs straight between: nodes
// that stand evenly (out_tree_resample) carry it exactly. Draws are keyed by node ids. ERROR_INPUT
// for a Hurst exponent out of range or lengths that make no sense; ERROR_CANCELLED.
bool out_tree_jitter(OutTree *tree, const JitterParams *params, const Run *run, Error *e);

#endif
