// A tree grown by light (grow/light/light.h): from its stems' feet, or from trunk and limbs that
// attractors laid.
#ifndef RAMIFY_OBJECTS_TREE_BY_LIGHT_H
#define RAMIFY_OBJECTS_TREE_BY_LIGHT_H

#include "objects/tree/defaults.h"

// Where a stem starts on the ground: on the circle of stems or inside it.
Vec3 tree_stem_foot(const TreeParams *params, int stem, uint64_t seed);

// Plants a node below the ground and one on it for each stem, so that the trunk's end is hidden.
bool tree_plant_stems(OutTree *tree, const TreeParams *params, uint64_t seed, Error *e);

// Replaces *tree, which has trunk and limbs or no node, by the grown tree with radii by the pipe
// model.
bool tree_grow_by_light(OutTree **tree, const TreePlan *plan, const Recipe *recipe, Error *e);

// One of several trees that grow side by side.
typedef struct StandTree {
    const TreeParams *params; // grown by light; envelopes, fields, roots and position are not used
    Vec3 foot;                // m
    uint64_t seed;
    OutTree *grown; // the result with radii, owned by the caller
} StandTree;

// Grows trees that shade each other, and their leaves' shade once more at the offsets `copy`, m:
// see light_grow_stand. On failure no tree is left.
bool tree_grow_stand(StandTree *tree, int count, const Vec3 *copy, int copies, const Recipe *recipe,
                     Error *e);

#endif
