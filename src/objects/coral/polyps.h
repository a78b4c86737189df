// Corallites: the stony cups that coral polyps sit in, spread over a skin at an even distance and
// leaning toward the branch's tip.
#ifndef RAMIFY_OBJECTS_CORAL_POLYPS_H
#define RAMIFY_OBJECTS_CORAL_POLYPS_H

#include "objects/common/recipe.h"
#include "objects/coral/coral.h"
#include "outtree/out_tree.h"

typedef struct PolypPlaces {
    PolypShape shape;
    int64_t max_count;
    float spacing;          // m, least distance between centres
    float diameter, height; // m, of a cup
    float lean;             // degrees from the skin's normal toward +v of its uv
    float fill;             // 0..1: share of the gaps with small cups
    float tentacles;        // 0..1: share of the polyps that are out
    float girth;            // m: usual radius of the branches; 0 = they stand on a plane
    float floor;            // m: no cups below this height
    const OutTree *tree;    // whose branches end in axial cups; NULL = none
    uint64_t seed;
} PolypPlaces;

// Adds the cups as instances of a few meshes, chosen by shape, the age (Mesh.birth) of the skin and
// chance. The spacing is widened if there would be more than max_count.
bool polyps_add(const Mesh *skin, const PolypPlaces *places, const Placing *placing, int role,
                Error *e);

#endif
