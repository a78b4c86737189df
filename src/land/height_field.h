// A height field: heights above a plane, sampled on a regular grid. What terrain is computed on,
// measured on and meshed from.
#ifndef RAMIFY_LAND_HEIGHT_FIELD_H
#define RAMIFY_LAND_HEIGHT_FIELD_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

// Samples stand at origin + (column * cell.x, row * cell.y) of the plane (x, z), row by row.
typedef struct HeightField {
    int columns, rows;
    Vec2 cell;      // m from sample to sample along x and z
    Vec2 origin;    // m: x and z of sample (0, 0)
    float *height;  // m
    float *wetness; // 0..1: 1 where water runs, 0 on dry slopes; NULL = not known
} HeightField;

enum { HEIGHT_FIELD_MOST = 16384 }; // samples a side

// All heights 0, no wetness. ERROR_INPUT for sizes below 2 or above HEIGHT_FIELD_MOST, and for
// cells that are not positive.
HeightField *height_field_new(int columns, int rows, Vec2 cell, Vec2 origin, Error *e);
void height_field_free(HeightField *field); // NULL is fine

static inline int64_t height_field_count(const HeightField *field)
{
    return (int64_t)field->columns * field->rows;
}

// The least and the greatest height.
void height_field_range(const HeightField *field, float *low, float *high);

// Height at any place, bilinear between samples; beyond the rim that of the rim.
float height_field_at(const HeightField *field, float x, float z);

// The same by Catmull-Rom splines: smooth slopes, through the samples.
float height_field_smooth_at(const HeightField *field, float x, float z);

// A 64-bit hash of sizes and heights: equal fields, equal hashes.
uint64_t height_field_hash(const HeightField *field);

#endif
