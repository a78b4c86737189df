// The land of the form delta, on the grid of its model (land/delta.h). Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_DELTA_H
#define RAMIFY_OBJECTS_TERRAIN_DELTA_H

#include "land/creeks.h"
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
    float *way_x;  // way of the water, unit or 0
    float *way_z;
    Creeks *creeks;   // NULL = none
    float *fine_load; // the water's mud, stirred, above 1 peat; NULL = not stirred
    int fine_columns, fine_rows;
} DeltaLand;

void delta_land_free(DeltaLand *land); // NULL is fine

// Cells a side of the grid: the river is DELTA_INLETS wide.
int terrain_delta_cells(const TerrainParams *params);

// A field of the model's cells at a place in cells, smooth: the mean around it by a quadratic
// B-spline.
float delta_land_at(const DeltaLand *land, const float *field, float u, float v);

// delta_creeks.c: fills land->creeks. density: 0..1, above 0.
bool delta_creeks_grow(DeltaLand *land, float density, uint64_t seed, const Run *run, Error *e);
// The ground at a place in cells, m, after a creek there has cut it. level: m, of the water.
float delta_creeks_cut(const DeltaLand *land, Vec2 at, float ground, float level);

// delta_stir.c: fills land->fine_load. amount: 0..1.
bool delta_stir(DeltaLand *land, float amount, uint64_t seed, const Run *run, Error *e);
// What is left of the mud where it flocculates in salt water and sinks, the thinner the more.
static inline float delta_settled(float load)
{
    return load * load * (1.7f - 0.7f * load);
}
float delta_stirred_at(const DeltaLand *land, Vec2 at);

// delta_land.c: what the grid's cells tell, of a model that has run.
bool delta_land_finish(DeltaLand *land, double total, Error *e);

#endif
