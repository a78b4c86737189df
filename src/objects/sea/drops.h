// Drops that crests which break throw into the air.
#ifndef RAMIFY_OBJECTS_SEA_DROPS_H
#define RAMIFY_OBJECTS_SEA_DROPS_H

#include "objects/sea/sea.h"

// The drops in the air at the sea's time near a place, in plan, as small closed bodies drawn out
// along their way. NULL on failure (ERROR_MEMORY), and with *none true where there are none. The
// caller frees the mesh. The same bits for any number of threads.
Mesh *sea_drops(const SeaParams *params, const Waves *waves, Vec2 center, uint64_t seed, bool *none,
                Error *e);

#endif
