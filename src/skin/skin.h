// Skins an out-tree with a closed, two-manifold, all-quad cage and smooths it with OpenSubdiv
// (Catmull-Clark).
//
// Texture coordinates of a skin, in metres: uv.y is the arc length along the branch from the root,
// continuous where a child leaves its parent. uv.x runs around the branch, from 0 both ways to half
// the circumference: mirrored, so that it has no seam. At a junction the parent's uv.x blends into
// the child's; patterns that must not show that use the position instead.
#ifndef RAMIFY_SKIN_SKIN_H
#define RAMIFY_SKIN_SKIN_H

#include "base/mesh.h"
#include "base/run.h"
#include "mesh/curves.h"
#include "outtree/out_tree.h"

typedef struct SkinParams {
    float min_radius; // m: thinner chains are not skinned (trace them as curves); 0 = skin all
    int levels;       // subdivision level of the thickest branches, 0..4 (0 = the cage itself)
    // spacing of the cage's rings on four-sided branches, in radii; typically 1. Thicker branches
    // have up to 32 sides and proportionally closer rings.
    float ring_spacing;
    int sides;    // least number of sides of trunks' cages, for forms that need them; 0 = by radius
    bool blunt;   // curves keep the tree's radii instead of tapering to their tips
    float collar; // how much thicker a branch is where it leaves its parent, as a share; 0 = none
    float swelling; // how far a branch swells at a limb as thick as itself, in radii; 0 = not
    float fluting;  // how high the strand below such a limb stands out, in radii; 0 = round
    float wall;     // roots are cut open: thickness of their wall in radii; 0 = they are closed
    int smoothing;  // relaxation passes over the chains before resampling; typically 2
} SkinParams;

SkinParams skin_params_default(void);

// Builds the cage: closed, two-manifold, all quads, one component per root, for any out-tree. Tubes
// have 4 to 32 sides, more on thicker branches; a child leaves through a block of its parent's
// faces about as wide as itself. Branches inside their parents are omitted. Radii are enlarged so
// that the limit surface has the out-tree's radius. Has uv (m), radius and birth. The caller frees
// it with mesh_free.
Mesh *skin_cage(const OutTree *tree, const SkinParams *params, const Run *run, Error *e);

// Builds the cage and refines it to the limit surface: thick branches to `levels`, thin ones to one
// or two less but at least 1. Triangles if levels differ, else quads. Memory beyond the result is a
// few tens of MB per thread. The caller frees it with mesh_free.
Mesh *skin_tree(const OutTree *tree, const SkinParams *params, const Run *run, Error *e);

// About how many triangles skin_tree will make (quads count as two), from lengths and radii alone.
// Within a factor of 1.5 on plants of usual shape.
double skin_estimate(const OutTree *tree, const SkinParams *params);

// The chains thinner than max_radius as round curves. Together with skin_tree at min_radius =
// max_radius every branch is shown exactly once (a curve's first point lies inside its parent's
// surface). The caller frees it with curves_free.
CurveSet *skin_curves(const OutTree *tree, float max_radius, const SkinParams *params, Error *e);

#endif
