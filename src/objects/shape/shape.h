// Envelopes drawn as solids: spheres, boxes, ...
#ifndef RAMIFY_OBJECTS_SHAPE_SHAPE_H
#define RAMIFY_OBJECTS_SHAPE_SHAPE_H

#include "objects/common/hoar.h"
#include "shape/envelope.h"

typedef struct SolidParams {
    Shape *shapes;
    int shape_count;
    float voxel;
    float checks; // m, depth of the deepest in weathered wood; 0 = no wood
    HoarParams hoar;
} SolidParams;

enum { SHAPE_OWN, SHAPE_RIME }; // roles of materials

extern const struct Table solid_table; // of its parameters

#endif
