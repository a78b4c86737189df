// Fallen leaves on the ground: those of one or of several kinds of trees.
#ifndef RAMIFY_OBJECTS_GROUND_LITTER_H
#define RAMIFY_OBJECTS_GROUND_LITTER_H

#include "objects/ground/ground.h"

// Adds the fallen leaves of the ground, if it has any. False after a failure or an interruption.
bool litter_add(const GroundParams *params, const Placing *placing, Error *e);

#endif
