// An out-tree traced by another program, from an SWC file: a neuron, a vessel tree, roots. It is
// placed, given a soma and skinned like a grown tree.
#ifndef RAMIFY_OBJECTS_SKELETON_SKELETON_H
#define RAMIFY_OBJECTS_SKELETON_SKELETON_H

#include "objects/common/branches.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

// The point placed at `position`: the file's origin, its first root, or the middle of its bounding
// box.
typedef enum SkeletonOrigin { SKELETON_FILE, SKELETON_ROOT, SKELETON_MIDDLE } SkeletonOrigin;

// Nodes of type 1 at a root: replaced by a round body of their size, kept, or left out.
typedef enum SkeletonSoma { SKELETON_ROUND, SKELETON_AS_IS, SKELETON_NO_SOMA } SkeletonSoma;

typedef struct SkeletonParams {
    char *file;  // SWC; borrowed
    float scale; // from its lengths to metres
    SkeletonOrigin origin;
    Vec3 position;                  // m
    Vec3 rotation;                  // degrees about x, then y, then z
    SkeletonSoma soma;              //
    bool axon, basal, apical, rest; // types to show: 2, 3, 4, and any other
    float radius_factor;
    float min_radius;   // m: least radius drawn; 0 = only nodes of radius 0 are replaced, by 0.0003
                        // of the extent
    int smoothing;      // smoothing passes over the branches
    float flare;        // how much wider branches are where they leave the soma; 0 = as in the file
    float spines;       // per unit of the file, along dendrites; drawn, not in the out-tree
    float spine_length; // in units of the file
    SkinningParams skin;
} SkeletonParams;

enum { SKELETON_BODY, SKELETON_AXON }; // roles of materials

SkeletonParams skeleton_params_default(void);

// The recipe (see recipe.h). Reads the file in a child process (out_tree_import_swc), selects,
// places and repairs it. Colonies are the types; births count the nodes from the root. ERROR_INPUT
// also if no node is left or coordinates are out of bounds.
bool skeleton_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
float skeleton_tip_radius(const void *params, const OutTree *whole); // m
bool skeleton_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Replaces the nodes of type 1 at roots (soma.c) by a chain of nodes with a ball's radii, toward
// the thickest branch that leaves it. The ball has the surface area of their segments, which is the
// meaning of a soma of three points, or the mean distance of an outline's points from their middle
// as its radius, whichever is larger. NULL and e on failure.
OutTree *skeleton_round_soma(const OutTree *tree, Error *e);

// Widens the bases of branches and adds spines to dendrites, as params say (dress.c).
bool skeleton_dress(OutTree *tree, const SkeletonParams *params, const Recipe *recipe, Error *e);

extern const struct Table skeleton_table; // of its parameters

#endif
