// Height fields: heights above a plane, sampled on a regular grid. Terrain is computed, measured
// and meshed on them.
#ifndef RAMIFY_LAND_HEIGHT_FIELD_H
#define RAMIFY_LAND_HEIGHT_FIELD_H

#include "base/error.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

// Where a field lies on the earth.
typedef struct GeoPlace {
    char *reference;       // owned: the coordinate reference system as WKT; NULL = none is known
    double east, north;    // its coordinates of x = 0, z = 0
    double unit_x, unit_z; // its units for a metre to the east, and for one to the north
} GeoPlace;

// Samples are at origin + (column * cell.x, row * cell.y) of the plane (x, z), row by row.
typedef struct HeightField {
    int columns, rows;
    Vec2 cell;      // m, sample spacing along x and z
    Vec2 origin;    // m: x and z of sample (0, 0)
    float *height;  // m
    float *wetness; // 0..1: 1 in rivers, 0 on dry slopes; NULL = unknown
    float *climate; // 0..1: the altitude as snow and plants feel it, of coasts km above the sea;
                    // NULL = the altitude
    float *change;  // m by which erosion has raised the land, negative where it has worn it; NULL =
                    // unknown
    float *loose;   // m of loose ground on the rock; NULL = unknown
    float *ground;  // of volcanoes: lava by its freshness, 1 = just laid, to 0 = none; scoria, -1 =
                    // red with oxide, to 0; NULL = unknown
    float *age;     // 0..1, of a river's valley: 0 = gravel that water has just moved, up to
                    // 0.6 where it has long lain; 0.8 = terraces, 1 = slopes; NULL = unknown
    float *water;   // m: level of the water, also under the ground beside it; -INFINITY where there
                    // is none near; NULL = unknown
    Vec2 *wind; // of sand: the wind's direction over it, shorter where less sand lies; NULL = none
    bool periodic;   // the last samples are the first again, and what lies beyond is a copy
    GeoPlace *place; // owned; NULL = anywhere
} HeightField;

enum { HEIGHT_FIELD_MAX = 16384 }; // samples per side

// All heights 0, no wetness. ERROR_INPUT for sizes below 2 or above HEIGHT_FIELD_MAX, and for cell
// sizes that are not positive. Free with height_field_free.
HeightField *height_field_new(int columns, int rows, Vec2 cell, Vec2 origin, Error *e);
void height_field_free(HeightField *field); // NULL is fine

static inline int64_t height_field_count(const HeightField *field)
{
    return (int64_t)field->columns * field->rows;
}

// Gives the field the place of another, if that has one, whose point (x, z) is the field's origin
// of coordinates.
bool height_field_take_place(HeightField *field, const HeightField *from, double x, double z,
                             Error *e);

// Of memory, all arrays.
int64_t height_field_bytes(const HeightField *field);

// The lowest and the highest height, m, of samples that have one; 0 if none has.
void height_field_range(const HeightField *field, float *low, float *high);

// Bilinear height at any point, m; outside the field, that of the rim.
float height_field_at(const HeightField *field, float x, float z);

// The same by Catmull-Rom interpolation, with continuous slopes.
float height_field_smooth_at(const HeightField *field, float x, float z);

// 64-bit hash of sizes and heights.
uint64_t height_field_hash(const HeightField *field);

#endif
