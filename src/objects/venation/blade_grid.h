// The grid of a blade: rows across it, whose columns fill it from margin to margin. Columns in the
// inner half run straight through the rows, whatever the margin does; the outer ones make room for
// teeth.
#ifndef RAMIFY_OBJECTS_VENATION_BLADE_GRID_H
#define RAMIFY_OBJECTS_VENATION_BLADE_GRID_H

#include "shape/leaf_outline.h"

// What a row needs of the outline, which takes long to find.
typedef struct BladeRow {
    float y, half; // m: height, and leaf_half_width there
    float more[2]; // m: what the margin adds to that on the left and on the right
} BladeRow;

BladeRow blade_row(const LeafOutline *outline, float y);

// x (m) of column u, 0..1 from the left margin to the right.
float blade_row_place(const BladeRow *row, float u);

// u of the place x, 0 and 1 beyond the margin; 0.5 where the blade has no width.
float blade_row_column(const BladeRow *row, float x);

// Row r and the middle of a pixel in it, of a picture of width x height, row by row from the tip.
BladeRow blade_pixel_row(const LeafOutline *outline, int height, int r);
Vec3 blade_pixel(const BladeRow *row, int width, int column);

#endif
