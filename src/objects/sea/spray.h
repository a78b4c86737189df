// Spray of surf before steep land.
#ifndef RAMIFY_OBJECTS_SEA_SPRAY_H
#define RAMIFY_OBJECTS_SEA_SPRAY_H

#include "mesh/spray.h"
#include "objects/sea/sea.h"

// What waves with a shore throw up at the sea's time, in the scene; none without a shore. The
// caller frees it. ERROR_MEMORY.
SprayParcels *sea_spray(const SeaParams *params, const Waves *waves, uint64_t seed, Error *e);

#endif
