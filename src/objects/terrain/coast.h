// The form coast. Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_COAST_H
#define RAMIFY_OBJECTS_TERRAIN_COAST_H

#include "land/shore.h"
#include "objects/terrain/internal.h"

// coast.c: the land as it is now; sea level is at height 0. terrain->ground: m to the edge of
// what waves have reached, negative there, on the same grid, as heights.
Landscape *terrain_evolve_coast(Terrain *terrain, const Run *run, Error *e);

// coast_measure.c: after terrain_evolve_coast.
bool terrain_measure_coast(const Terrain *terrain, MeasureList *list, Error *e);

#endif
