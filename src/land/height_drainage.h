// Drainage of a height field: eight neighbours, steepest descent (O'Callaghan and Mark 1984), pits
// removed by priority flood (Barnes 2014). Samples are ordered by height, ties by index, so the
// result is the same on every machine.
#ifndef RAMIFY_LAND_HEIGHT_DRAINAGE_H
#define RAMIFY_LAND_HEIGHT_DRAINAGE_H

#include "land/height_field.h"

typedef struct Drainage {
    int64_t samples;   // of the field: receiver, area and filled have a value for each
    int64_t count;     // those of them that drain, which are all with a height
    int32_t *receiver; // the neighbour that a sample drains to; itself on the rim (an outlet)
    int32_t *order;    // the `count` that drain, every receiver before its donors
    double *area;      // m^2: catchment area of a sample, including its own cell
    float *filled;     // m: water level if all pits were full, >= height
    int64_t pits;      // inner samples without a lower neighbour
} Drainage;

// Routes the whole field to its rim (and to non-finite samples, which count as outside). Water
// leaves a pit over its lowest pass. Free with drainage_free.
Drainage *drainage_new(const HeightField *field, Error *e);
void drainage_free(Drainage *drainage); // NULL is fine

// The flood alone: filled and receiver, which leads along the flood's way, not down the steepest
// slope; areas are 0 and order is NULL. Samples that cannot be reached receive themselves. outlet:
// per sample, 1 = water leaves there and nowhere else; NULL = over the rim.
Drainage *drainage_flood(const HeightField *field, const uint8_t *outlet, Error *e);

// The same over the rim, but with level pools: filled is the height of the lowest way's highest
// sample, to the bit. The receiver of a pool's first sample is the sample over which it spills.
Drainage *drainage_spill(const HeightField *field, Error *e);

// Raises samples by the least amount that lets every one drain: each ends up above its receiver by
// a slope of at least `fall` (0 = by one float step).
bool height_field_fill(HeightField *field, float fall, Error *e);

// Counts the inner samples without a lower neighbour.
int64_t height_field_pits(const HeightField *field);

#endif
