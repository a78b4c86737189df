// Instanced meshes that snow settles on, such as sprays of needles, and what of them bears it.
#ifndef RAMIFY_OBJECTS_COMMON_SNOW_SPRAY_H
#define RAMIFY_OBJECTS_COMMON_SNOW_SPRAY_H

#include "mesh/snow/snow.h"
#include "objects/common/recipe.h"

// An instanced mesh that snow settles on.
typedef struct Spray {
    const Part *part;
    Vec3 size, middle; // m, of the mesh's bounds
    float length;      // m, the largest of its sizes
} Spray;

// Does snow settle on a part's instances? Then *spray is set; it keeps the part's address.
bool snow_spray_of(const Part *part, Spray *spray);

// The middle of an instance, m.
Vec3 snow_spray_middle(const Spray *spray, int64_t instance);

// What of a spray bears snow: its faces, gathered in small cubes.
typedef struct SprayBearers {
    SnowBearer *bearer; // in the spray's space; free it
    int64_t count;
} SprayBearers;

bool snow_spray_bearers(const Mesh *mesh, SprayBearers *all, Error *e);

#endif
