// The grid of a blade: rows across it, whose columns fill it from margin to margin. Columns in the
// inner half run straight through the rows, whatever the margin does; the outer ones make room for
// teeth.
#ifndef RAMIFY_OBJECTS_VENATION_BLADE_GRID_H
#define RAMIFY_OBJECTS_VENATION_BLADE_GRID_H

#include "shape/leaf_outline.h"

// x (m) of column u, 0..1 from the left margin to the right, at height y.
float blade_column_place(const LeafOutline *outline, float u, float y);

// u of the place x at height y, 0 and 1 beyond the margin; 0.5 where the blade has no width.
float blade_column(const LeafOutline *outline, float x, float y);

// Middle of a pixel of a picture of width x height, row by row from the tip, on the flat leaf.
Vec3 blade_pixel(const LeafOutline *outline, int width, int height, int column, int row);

#endif
