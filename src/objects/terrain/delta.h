// The land of the form delta, on the grid of its model (land/delta.h). Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_DELTA_H
#define RAMIFY_OBJECTS_TERRAIN_DELTA_H

#include "land/delta.h"
#include "objects/terrain/internal.h"

enum { DELTA_INLETS = 5, DELTA_LEAST_CELLS = 80, DELTA_MOST_CELLS = 320 };

// How far the water has fallen below the level that built the land, of the river's depth.
#define DELTA_FALL 0.05

// What a place looks up, of each cell of the model.
typedef struct DeltaLand {
    Delta *model;
    double corner; // m: x and z of the grid's corner
    float *ground; // m
    float *level;  // m, of the water, also beneath dry land
    float *levee;  // 1 in channels, 0 from three cells on
    float *age;    // HeightField.age
    float *load;   // mud in the water, of that in the river
} DeltaLand;

void delta_land_free(DeltaLand *land); // NULL is fine

// Cells a side of the grid: the river is DELTA_INLETS wide.
int terrain_delta_cells(const TerrainParams *params);

// delta_land.c: what the grid's cells tell, of a model that has run.
bool delta_land_finish(DeltaLand *land, double total, Error *e);

#endif
