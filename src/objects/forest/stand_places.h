// Where a forest's stands stand. Shared by forest.c and forest_geometry.c.
#ifndef RAMIFY_OBJECTS_FOREST_STAND_PLACES_H
#define RAMIFY_OBJECTS_FOREST_STAND_PLACES_H

#include "objects/forest/forest.h"

float forest_stand_radius(const ForestParams *params); // m

// The nodes of one stand of a grown forest, moved to the origin; the caller frees it.
OutTree *forest_stand(const OutTree *all, const ForestParams *params, int stand, Error *e);

typedef struct StandPlaces {
    Transform *place; // from a stand at the origin to its place on the land
    int *stand;       // which one
    int64_t count, place_capacity, stand_capacity;
} StandPlaces;

// On the land and off the water of the surroundings.
bool stand_places_init(StandPlaces *places, const ForestParams *params, uint64_t seed,
                       const Surroundings *around, const Run *run, Error *e);
void stand_places_free(StandPlaces *places);

#endif
