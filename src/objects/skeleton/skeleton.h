// An out-tree that another program traced, from an SWC file: a neuron, a vessel tree, roots. It is
// placed, given a soma and skinned as what grows here is.
#ifndef RAMIFY_OBJECTS_SKELETON_SKELETON_H
#define RAMIFY_OBJECTS_SKELETON_SKELETON_H

#include "objects/common/recipe.h"
#include "objects/tree/tree.h"
#include "outtree/out_tree.h"

// What goes to `position`: the file's own origin, its first root, or the middle of its box.
typedef enum SkeletonOrigin { SKELETON_FILE, SKELETON_ROOT, SKELETON_MIDDLE } SkeletonOrigin;

// Nodes of type 1 at a root: made one round body of about their size, taken as they are, left out.
typedef enum SkeletonSoma { SKELETON_ROUND, SKELETON_AS_IS, SKELETON_NO_SOMA } SkeletonSoma;

typedef struct SkeletonParams {
    char *file;  // SWC; borrowed
    float scale; // of its lengths to metres
    SkeletonOrigin origin;
    Vec3 position;                  // m
    Vec3 rotation;                  // degrees about x, then y, then z
    SkeletonSoma soma;              //
    bool axon, basal, apical, rest; // types to show: 2, 3, 4, and any other
    float radius_factor;
    float min_radius; // m: thinner ways are drawn this thick; 0 = only those of radius 0 are, with
                      // 0.0003 of the extent
    int smoothing;    // passes over the ways' bends
    SkinningParams skin;
} SkeletonParams;

enum { SKELETON_BODY, SKELETON_AXON }; // roles of materials

SkeletonParams skeleton_params_default(void);

// The recipe (see recipe.h). Reads the file in a child process (out_tree_import_swc), picks, places
// and mends it. Colonies are the types; births count the nodes from the root. ERROR_INPUT also when
// nothing is left of it or it is out of all bounds.
bool skeleton_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
float skeleton_tip_radius(const void *params, const OutTree *whole); // m
bool skeleton_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// The part of skeleton_grow that replaces the nodes of type 1 at roots (skeleton_soma.c): by a
// chain of nodes as thick as a ball is, along the way to the thickest of what leaves it. The ball
// has the area of their segments, which is what a soma of three points stands for, or the mean
// distance of an outline's points from their middle as its radius, whichever is larger. NULL and e.
OutTree *skeleton_round_soma(const OutTree *tree, Error *e);

extern const struct Table skeleton_table; // of its parameters

#endif
