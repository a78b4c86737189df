// What an object knows of the scene around it.
#ifndef RAMIFY_OBJECTS_COMMON_SURROUNDINGS_H
#define RAMIFY_OBJECTS_COMMON_SURROUNDINGS_H

#include "render/material/material.h"

#include <stddef.h>

// Where water covers the land: no plant is placed there.
typedef struct Flood {
    bool (*covers)(const void *user, Vec3 foot); // is the land at this place under water?
    const void *user;                            // borrowed
} Flood;

// The ground that objects stand on, in the own space of the object that asks.
typedef struct Land {
    float (*height)(const void *user, float x, float z); // m; NULL = level land at height 0
    const void *user;                                    // borrowed
} Land;

// Zero = nothing: an object alone.
typedef struct Surroundings {
    const Vec3 *eye;          // the camera; NULL = none
    const Material *material; // the world's list, indexed by Placing.material; NULL = not known
    const Flood *flood;       // NULL = no water
    Land land;
} Surroundings;

static inline bool flood_covers(const Flood *flood, Vec3 foot)
{
    return flood != NULL && flood->covers(flood->user, foot);
}

static inline float land_height(const Land *land, float x, float z)
{
    return land->height ? land->height(land->user, x, z) : 0.0f;
}

#endif
