// What branches of an out-tree look like: parameters of radii and skin that several kinds have,
// their tables, and the parts that show branches and their leaves.
#ifndef RAMIFY_OBJECTS_COMMON_BRANCHES_H
#define RAMIFY_OBJECTS_COMMON_BRANCHES_H

#include "objects/common/leaf_place.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"
#include "skin/skin.h"

typedef enum RadiusModel { RADIUS_PIPE, RADIUS_BIRTH } RadiusModel;

typedef struct RadiiParams {
    RadiusModel model;
    float exponent;     // pipe model, r_parent^e = sum r_child^e
    float tip;          // m, radius of the twigs' tips
    float flare;        // extra width of the trunk at the ground; 0.5 = 1.5 times as wide
    float flare_height; // m; 0 = 2.5 trunk radii
} RadiiParams;

typedef struct SkinningParams {
    float curve_radius;      // m: thinner twigs are curves; 0 = all is mesh
    int levels;              // subdivision, 0..4
    float ring_spacing;      // in radii
    float collar;            // share by which a branch is thicker where it leaves its parent
    float swelling, fluting; // in radii, see skin/skin.h
} SkinningParams;

extern const struct Table radii_table, skin_table;

// The skin's parameters as skin/skin.h has them.
SkinParams branches_skin(const SkinningParams *skin);

// How twigs and their leaves are shown.
typedef struct TwigParams {
    const SkinningParams *skin;
    const LeavesParams *leaves; // NULL = none
    LeafLight light;            // that they turn to
    int32_t bare_from;          // colonies from this number on bear no leaves; -1 = all do
    uint64_t seed;              // of the leaves
    int twig_role, leaf_role;   // of the kind's materials
} TwigParams;

// Marks the curves of the colonies from `first` on; the caller frees the list of one entry a curve.
bool *branches_bare(const OutTree *tree, const CurveSet *curves, int32_t first, Error *e);

// Adds the branches thinner than skin->curve_radius as curves, and the leaves on thin branches.
// Leaves are placed on the curves drawn as twigs, so that none floats. If every twig is mesh, the
// curves are made for the leaves alone. A warning tells if most branches that are thin enough for
// leaves have none, because they are mesh.
bool branches_add_twigs(const OutTree *tree, const TwigParams *params, const Placing *placing,
                        Error *e);

#endif
