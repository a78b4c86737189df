// The form karst. Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_KARST_H
#define RAMIFY_OBJECTS_TERRAIN_KARST_H

#include "land/karst.h"
#include "objects/terrain/internal.h"

// karst.c: the land as it is now; the water table is at height 0, the plain a little above it.
Landscape *terrain_evolve_karst(Terrain *terrain, const Run *run, Error *e);

// karst_measure.c: after terrain_evolve_karst.
bool terrain_measure_karst(const Terrain *terrain, MeasureList *list, Error *e);

// Share of the relief: the plain's alluvium away from the river.
#define KARST_ALLUVIUM 0.02
// The deepest of the river's bed below the water table.
#define KARST_BED 0.02

#endif
