// Places of single trees in a forest of species: each individual where it belongs.
#ifndef RAMIFY_OBJECTS_FOREST_TREE_PLACES_H
#define RAMIFY_OBJECTS_FOREST_TREE_PLACES_H

#include "objects/forest/individuals.h"

typedef struct TreePlaces {
    Transform *place; // from an individual at the origin to its place on the land
    int *individual;  // its index
    int64_t count, place_capacity, individual_capacity;
} TreePlaces;

// On the land of the surroundings and outside of its water. Trees with open land beside them are
// those of an edge, turned toward it, or of the open.
bool tree_places_init(TreePlaces *places, const ForestParams *forest, const Individuals *all,
                      uint64_t seed, const Surroundings *around, const Run *run, Error *e);
void tree_places_free(TreePlaces *places);

#endif
