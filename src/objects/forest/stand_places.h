// Places of a forest's stands. Shared by forest.c and geometry.c.
#ifndef RAMIFY_OBJECTS_FOREST_STAND_PLACES_H
#define RAMIFY_OBJECTS_FOREST_STAND_PLACES_H

#include "objects/forest/forest.h"

float forest_stand_radius(const ForestParams *params); // m

// The nodes of one stand of a grown forest, moved to the origin; the caller frees it.
OutTree *forest_stand(const OutTree *all, const ForestParams *params, int stand, Error *e);

typedef struct StandPlaces {
    Transform *place; // from a stand at the origin to its place on the land
    int *stand;       // index of the stand
    int64_t count, place_capacity, stand_capacity;
} StandPlaces;

// Places on the land of the surroundings and outside of its water.
bool stand_places_init(StandPlaces *places, const ForestParams *params, uint64_t seed,
                       const Surroundings *around, const Run *run, Error *e);
void stand_places_free(StandPlaces *places);

#endif
