// Lakes of a terrain: hollows of its land, or basins dug into it, full to their spill level.
// Private to this folder.
//
// While rivers are laid and pits are filled, lakes are covered: their samples are level land at the
// height of the water. Their beds come back last.
#ifndef RAMIFY_OBJECTS_TERRAIN_LAKES_H
#define RAMIFY_OBJECTS_TERRAIN_LAKES_H

#include "land/lakes.h"
#include "objects/terrain/internal.h"

// With numbers in place of 0.
TerrainLakeParams terrain_lake_params(const TerrainParams *params);

// lakes.c: before pits are filled: covers the hollows of the land that may become lakes.
bool terrain_cover_hollows(Terrain *terrain, HeightField *field, Error *e);
// Uncovers them, digs basins, then finds the lakes and covers them: fills terrain->lakes and
// ->lake_depth.
bool terrain_find_lakes(Terrain *terrain, HeightField *field, const Run *run, Error *e);
// When nothing else changes the land: brings back the beds, shapes the shores, fills terrain->bank
// and records the lakes' levels in field->water.
bool terrain_uncover_lakes(Terrain *terrain, HeightField *field, Error *e);
// The level of the lake at a place, m; -INFINITY if there is none.
float terrain_lake_at(const Terrain *terrain, const HeightField *field, float x, float z);

// basins.c: digs basins as glaciers do: into the flattest ground above outlets.
bool terrain_dig_basins(const Terrain *terrain, HeightField *field, const Run *run, Error *e);

// lake_shore.c: beaches along the shores of the lakes, which are uncovered.
bool terrain_shape_shores(const Terrain *terrain, HeightField *field, Error *e);

// lake_water.c: number, area, depth and place of the largest; nothing without lakes.
bool terrain_measure_lakes(const Terrain *terrain, MeasureList *list, Error *e);

#endif
