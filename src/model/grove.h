// Woods in the distance: a few trees grown coarsely, their leaves baked into one mesh each, and
// instanced over the land.
#ifndef RAMIFY_MODEL_GROVE_H
#define RAMIFY_MODEL_GROVE_H

#include "model/ground.h"

bool grove_add(const GroundParams *ground, const GroundMaterials *materials, int object,
               uint64_t ground_seed, Geometry *geometry, const Run *run, Error *e);

#endif
