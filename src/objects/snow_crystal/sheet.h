// The form of a flat snow crystal as fields over a lattice, from which its surface is made: the
// crystal's own cells, or `detail` points to a cell.
#ifndef RAMIFY_OBJECTS_SNOW_CRYSTAL_SHEET_H
#define RAMIFY_OBJECTS_SNOW_CRYSTAL_SHEET_H

#include "objects/snow_crystal/snow_crystal.h"

// Of the smoothed cells: less than half, so that branches of one cell hold.
#define SHEET_CONTOUR 0.42f

// Point (q, r) of the lattice, -radius .. radius each, is element sheet_at. There is a margin
// without ice.
typedef struct Sheet {
    int radius, width;
    int64_t cells;
    float *inside; // smoothed cells: the crystal's outline is at SHEET_CONTOUR
    float *height; // half its thickness, m
    float *ring;   // how far the upper face stands out beyond that, m; NULL = nowhere
    float *ridge;  // smoothed mass
    float *spare;
    int32_t *vertex; // of a point's upper face; -1 = outside; for the mesh, all -1 at first
    int32_t *cut[3]; // vertex where the outline cuts the way to a neighbour; -1 = nowhere
} Sheet;

// Fills all fields. Free with sheet_clear, whether it succeeds or not.
bool sheet_make(Sheet *sheet, const SnowCrystalParams *params, const Snowfake *fake, uint64_t seed,
                Error *e);

void sheet_clear(Sheet *sheet);

static inline int64_t sheet_at(const Sheet *sheet, int q, int r)
{
    return (int64_t)(r + sheet->radius) * sheet->width + q + sheet->radius;
}

#endif
