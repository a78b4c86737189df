// A vector field sampled on a sparse voxel grid with trilinear interpolation (Tanaka 4.4). Blocks
// of voxels in which the field is nearly linear store only their corners.
#ifndef RAMIFY_FIELD_FIELD_GRID_H
#define RAMIFY_FIELD_FIELD_GRID_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct FieldGrid {
    Vec3 low;
    float voxel;   // m
    int blocks[3]; // along each axis
    Vec3 *corner;  // values at the block corners, (blocks + 1) along each axis
    int32_t *leaf; // per block: index of its leaf in `value`, or -1 if the corners suffice
    Vec3 *value;   // leaves: values at the corners of their voxels
    int64_t leaf_count;
} FieldGrid;

typedef Vec3 FieldFunction(const void *context, Vec3 p);

// Samples f over bounds with `resolution` voxels along the longest side. ERROR_INPUT when the
// resolution is not in 1..2048. Free with field_grid_free.
bool field_grid_init(FieldGrid *grid, FieldFunction *f, const void *context, Aabb bounds,
                     int resolution, const Run *run, Error *e);
void field_grid_free(FieldGrid *grid);

// Value at p; outside the bounds, that of the nearest point in them.
Vec3 field_grid_at(const FieldGrid *grid, Vec3 p);

#endif
