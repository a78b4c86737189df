// The library of species as a table for readers.
#ifndef RAMIFY_SCENE_SPECIES_LIST_H
#define RAMIFY_SCENE_SPECIES_LIST_H

#include "base/error.h"

// A line for each species of the library: name, Latin name, form, height in metres, and the months
// of its leaves and organs. Heap text; NULL and e: ERROR_MEMORY.
char *species_list(Error *e);

#endif
