// The stony cups of corals as meshes, in diameters of their rims: about +Y, which is the normal of
// the skin that they stand on, open at the foot.
#ifndef RAMIFY_OBJECTS_CORAL_CUP_H
#define RAMIFY_OBJECTS_CORAL_CUP_H

#include "base/mesh.h"

// A straight, round tube; youth: its births (0..1), higher at the rim.
Mesh *polyp_cup(float height, float youth, Error *e);

// A cup as of Acropora, "nariform" in descriptions of its species: it bends out of the tissue and
// along the branch, toward -Z, its outer lip is longer than its inner one, and no two are alike.
// The proportions are our own.
typedef struct NoseCup {
    float height;  // of the outer wall, along the cup's bent axis
    float lean;    // degrees by which the axis is bent at the rim
    float oblique; // 0..1: how much shorter the inner lip is
    float flare;   // 0..1: how far the foot spreads into the tissue
    float girth;   // radius of the branch, along Z, around which the foot is bent; 0 = a plane
    float reach;   // length of the polyp's twelve tentacles; 0 = they are drawn in
    float youth;   // births (0..1), higher at the rim
    uint64_t seed; // of its irregularities
} NoseCup;

Mesh *polyp_nose(const NoseCup *nose, Error *e);

#endif
