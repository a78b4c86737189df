// Transforms decomposed for formats that store translation, rotation and scale.
#ifndef RAMIFY_EXPORT_PLACEMENT_H
#define RAMIFY_EXPORT_PLACEMENT_H

#include "base/vec.h"

// Scale, then rotate, then translate. A mirroring transform has a negative scale.x.
typedef struct Placement {
    Vec3 position;
    float rotation[4]; // unit quaternion x, y, z, w with w >= 0
    Vec3 scale;
} Placement;

// False if the transform shears or flattens, which no placement can express.
bool placement_from_transform(const Transform *t, Placement *placement);

// Expresses any transform that does not flatten as two: first rotate by the unit quaternion turn,
// then place. False if the transform flattens.
bool placement_of_turned(const Transform *t, float turn[4], Placement *placement);

#endif
