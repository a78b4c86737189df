// A forest: trees that compete for the same light and space. A few stands of some trees each are
// grown as one growth with a colony per tree, so that every crown ends where its neighbour's begins
// (crown shyness) and a tree that is overtopped stays thin; then the stands are set side by side
// over the land, turned and scaled, by the thousand. Under them grow ferns.
#ifndef RAMIFY_OBJECTS_FOREST_FOREST_H
#define RAMIFY_OBJECTS_FOREST_FOREST_H

#include "mesh/geometry.h"
#include "objects/common/recipe.h"
#include "objects/tree/mix.h"

typedef struct ForestParams {
    float height;    // m, of the tallest trees
    float spacing;   // m from trunk to trunk; 0 = 0.24 of the height
    int stand_trees; // trees grown together in a stand
    int stands;      // different stands
    float crown;     // share of the height with branches, from the top
    float radius;    // m, of the forest about `center`
    Vec3 center;     // m
    float glade;     // m: no stand within this of glade_center
    Vec3 glade_center;
    float density;         // 0..1, share of the places taken where the forest is densest
    float clumping;        // 0 = even .. 1 = woods with open land between
    float max_slope;       // degrees: no trees on steeper land
    int64_t ferns;         // 0 = none
    float fern_height;     // m
    float fern_radius;     // m about glade_center that bear ferns
    ElementParams element; // growth of the crowns
    RadiiParams radii;
    LeavesParams leaves; // max_count of one stand
    SkinningParams skin;
    float season;       // month, as TreeParams.season; 0 = as the species have it
    TreeShare *species; // grown by light; none: plain trees grown by attractors
    int species_count;
} ForestParams;

enum { FOREST_BARK, FOREST_TWIG, FOREST_LEAF, FOREST_FERN }; // roles; the first as a tree's

ForestParams forest_params_default(void);

// Fills in numbers that are 0 from the other parameters. Borrows the arrays of params.
ForestParams forest_params_resolve(const ForestParams *params);

// The recipe (see recipe.h). Grows all stands as one out-tree, side by side along x: one colony a
// tree, stand by stand. The geometry places them over the land with ferns below, outside of water.
bool forest_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
float forest_tip_radius(const void *params, const OutTree *whole); // m
bool forest_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Crown shyness: median distance (m) from a tip to the nearest branch of another tree in the stand,
// over tips with one within half a trunk spacing; NAN without any. 0 = crowns interleave.
bool forest_crown_gap(const OutTree *tree, const ForestParams *params, double *gap, Error *e);

extern const struct Table forest_table; // of its parameters

#endif
