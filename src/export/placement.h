// Transforms taken apart into what other formats keep of an instance.
#ifndef RAMIFY_EXPORT_PLACEMENT_H
#define RAMIFY_EXPORT_PLACEMENT_H

#include "base/vec.h"

// Scale, then turn, then move. A mirroring transform has a negative scale.x.
typedef struct Placement {
    Vec3 position;
    float rotation[4]; // unit quaternion x, y, z, w with w >= 0
    Vec3 scale;
} Placement;

// False when the transform shears or flattens, so that no placement is the same.
bool placement_from_transform(const Transform *t, Placement *placement);

// Any transform that does not flatten as a placement of a turned thing: first turn by the unit
// quaternion turn, then place. False when the transform flattens.
bool placement_of_turned(const Transform *t, float turn[4], Placement *placement);

#endif
