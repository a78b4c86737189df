// Settled snow: cushions along branches and on flat sprays.
#ifndef RAMIFY_MESH_SNOW_SNOW_H
#define RAMIFY_MESH_SNOW_SNOW_H

#include "base/mesh.h"
#include "base/run.h"
#include "mesh/curves.h"

typedef struct SnowParams {
    float depth;    // m, on a level place in the open; 0 = none
    float steepest; // degrees from the level: snow slides off what is steeper
    float gaps;     // 0..1: share of the branches that have lost theirs
} SnowParams;

// Which share (0..1) of the snow comes to p.
typedef struct SnowReach {
    float (*share)(const void *user, Vec3 p);
    const void *user;
} SnowReach;

// How much of the full depth stays on a place that is tilted so that the cosine of its angle to the
// level is `level`: 1 on a level place, 0 beyond the steepest.
float snow_stays(const SnowParams *params, float level);

// The cushions along the upper sides of all curves as one mesh of quads with normals: closed but
// for their ends, which lie inside the branches. Snow is as deep as a branch is wide at most,
// deeper where it is wider, with gaps and lumps by the curves' ids. bare: one entry per curve, true
// = without snow; NULL = all bear it. May have no faces. The caller frees it with mesh_free.
Mesh *snow_on_curves(const CurveSet *curves, const bool *bare, const SnowParams *params,
                     const SnowReach *reach, const Run *run, Error *e);

// The cushion on one side of a flat spray (needles, a frond), toward its +Z or, if `turned`, its
// -Z, of cells times 2 cells along its X and Y: closed, of quads with normals. depth: m, in the
// middle. May have no faces. The caller frees it with mesh_free.
Mesh *snow_on_spray(const Mesh *spray, float depth, bool turned, int cells, Error *e);

#endif
