// The space in which sea fans grow.
#ifndef RAMIFY_OBJECTS_CORAL_FAN_H
#define RAMIFY_OBJECTS_CORAL_FAN_H

#include "objects/coral/coral.h"
#include "shape/points.h"

// Attractors in the plane z = position.z: in half ellipses over the feet or, the more the fan is
// uneven, in petals that spread from the feet and are bent out of the plane. seed: of the points.
// Free with points_free.
PointSet *fan_room(const CoralParams *resolved, uint64_t seed, Error *e);

#endif
