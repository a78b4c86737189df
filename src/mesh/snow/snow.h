// Settled snow: cushions along branches, and pillows on boughs of needles.
#ifndef RAMIFY_MESH_SNOW_SNOW_H
#define RAMIFY_MESH_SNOW_SNOW_H

#include "base/mesh.h"
#include "base/run.h"
#include "mesh/curves.h"

typedef struct SnowParams {
    float depth;    // m, on a level place in the open; 0 = none
    float steepest; // degrees from the level: snow slides off what is steeper
    float gaps;     // 0..1: share of the branches that have lost theirs
    float bridging; // m: widest gap between twigs or needles that snow spans
    float crumbs;   // m: largest crumb on needles outside of pillows; 0 = none
    float fray;     // 0..1: how far pillows follow single twigs and needles; 0 = smooth
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

// A little of what bears a pillow, such as a few needles.
typedef struct SnowBearer {
    Vec3 p;     // m
    float area; // m2
} SnowBearer;

// A crumb of snow on a needle or twig.
typedef struct SnowCrumb {
    Vec3 p;       // m, its middle
    float radius; // m
} SnowCrumb;

typedef struct SnowCrumbs {
    SnowCrumb *crumb; // owned
    int64_t count, capacity;
} SnowCrumbs;

// Pillows as they are gathered. Initialize to {0}; clear with snow_pile_clear.
typedef struct SnowPile {
    Vec3 *position; // m
    int64_t vertex_count, vertex_capacity;
    uint32_t *index; // three a face
    int64_t index_count, index_capacity;
    SnowCrumbs crumbs; // beside them
} SnowPile;

void snow_pile_clear(SnowPile *pile);

// Adds the pillows on one bough: closed bodies of triangles that face outward, params->depth deep
// on wide level places that snow reaches, as thick as half their width on narrow ones, with round
// rims that overhang a little; with params->fray these are ragged, and the surface is as uneven as
// the twigs below and the clods that fell on it. Snow settles first on the highest bearers, then on
// those far below its surface. The bearers are reordered. seed: of lumps and gaps. With
// params->crumbs, crumbs lie on the topmost bearers outside.
bool snow_add_pillows(SnowPile *pile, SnowBearer *bearer, int64_t count, const SnowParams *params,
                      const SnowReach *reach, uint64_t seed, Error *e);

// The pile as one mesh of triangles with normals; may have no faces. The caller frees it with
// mesh_free.
Mesh *snow_pile_mesh(const SnowPile *pile, Error *e);

#endif
