// Skins an out-tree with a closed, two-manifold, all-quad cage and smooths it with OpenSubdiv
// (Catmull-Clark).
//
// Texture coordinates of a skin, in metres: uv.y runs along the branch from the root, without a
// jump where a child leaves its parent. uv.x runs around, from 0 on one side both ways to half the
// girth on the other: mirrored, so that it needs no seam. Where a child leaves, the parent's uv.x
// fades into the child's; patterns that must not show that take the position instead.
#ifndef RAMIFY_SKIN_SKIN_H
#define RAMIFY_SKIN_SKIN_H

#include "base/mesh.h"
#include "base/run.h"
#include "mesh/curves.h"
#include "outtree/out_tree.h"

typedef struct SkinParams {
    float min_radius;   // m: chains thinner than this are not skinned (trace them as curves); 0 =
                        // skin all
    int levels;         // subdivision of the thickest branches, 0..4 (the cage itself at 0)
    float ring_spacing; // distance between the cage's rings, in radii, on four-sided branches; 1
                        // usual. Thicker ones have up to 32 sides and rings as much closer.
    int smoothing;      // relaxation passes over the chains before resampling; 2 usual
} SkinParams;

SkinParams skin_params_default(void);

// The cage: closed, two-manifold, all quads, one component a root (whatever the out-tree). Tubes
// have 4 to 32 sides, more on thicker branches; a child leaves through a block of its parent's
// faces about as wide as itself. Branches that lie inside their parents are left out. Radii are
// enlarged so that the limit surface has the out-tree's radius. Carries uv (m), radius and birth.
Mesh *skin_cage(const OutTree *tree, const SkinParams *params, const Run *run, Error *e);

// skin_cage, then refinement to the limit surface: thick branches to `levels`, thin ones to one or
// two less but 1 at least; made of triangles if levels differ, else of quads. Memory beyond the
// result is a few tens of MB a thread.
Mesh *skin_tree(const OutTree *tree, const SkinParams *params, const Run *run, Error *e);

// The chains thinner than max_radius as round curves; together with skin_tree at min_radius =
// max_radius nothing is missing and nothing shows twice (a curve's first point lies inside its
// parent's surface).
CurveSet *skin_curves(const OutTree *tree, float max_radius, const SkinParams *params, Error *e);

#endif
