// Envelopes drawn as solids: spheres, boxes, ...
#ifndef RAMIFY_OBJECTS_SHAPE_SHAPE_H
#define RAMIFY_OBJECTS_SHAPE_SHAPE_H

#include "shape/envelope.h"

typedef struct SolidParams {
    Shape *shapes;
    int shape_count;
    float voxel;
} SolidParams;

extern const struct Table solid_table; // of its parameters

#endif
