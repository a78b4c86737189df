// Where water covers the land: nothing that grows on land is set there.
#ifndef RAMIFY_OBJECTS_GROUND_FLOOD_H
#define RAMIFY_OBJECTS_GROUND_FLOOD_H

#include "base/vec.h"

#include <stddef.h>

typedef struct Flood {
    bool (*covers)(const void *user, Vec3 foot); // is the land at this place under water?
    const void *user;                            // borrowed
} Flood;

// NULL = all is dry.
static inline bool flood_covers(const Flood *flood, Vec3 foot)
{
    return flood != NULL && flood->covers(flood->user, foot);
}

#endif
