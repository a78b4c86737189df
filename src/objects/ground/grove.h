// Distant woods: a few coarsely grown trees, each with its leaves baked into one mesh, instanced
// over the land.
#ifndef RAMIFY_OBJECTS_GROUND_GROVE_H
#define RAMIFY_OBJECTS_GROUND_GROVE_H

#include "objects/ground/ground.h"

// How many of `count` instances variant number `variant` has: equal shares, the first variants take
// the remainder.
static inline int64_t grove_share(int64_t count, int variants, int variant)
{
    return count / variants + (variant < count % variants ? 1 : 0);
}

bool grove_add(const GroundParams *ground, const Placing *placing, Error *e);

// Moves a part of a single tree into the geometry, instanced at every place. Leaves are first baked
// into one mesh.
bool grove_add_part(Geometry *geometry, Part *part, const Transform *place, int64_t count,
                    const Run *run, Error *e);

#endif
