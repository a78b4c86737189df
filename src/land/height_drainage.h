// Where water runs on a height field: eight neighbours, steepest descent (O'Callaghan and Mark
// 1984), pits removed by priority flood (Barnes, Lehman and Mulla 2014). The order is that of
// heights, ties by index: the same bits on every machine.
#ifndef RAMIFY_LAND_HEIGHT_DRAINAGE_H
#define RAMIFY_LAND_HEIGHT_DRAINAGE_H

#include "land/height_field.h"

typedef struct Drainage {
    int64_t count;
    int32_t *receiver; // the neighbour that a sample drains to; itself on the rim (an outlet)
    int32_t *order;    // all samples, every receiver before its donors
    double *area;      // m^2 that drain through a sample, its own cell too
    float *filled;     // m: the height of the water that would stand there: >= height
    int64_t pits;      // samples off the rim without a lower neighbour
} Drainage;

// Routes the whole field to its rim (and to samples that are not finite: outside). Water leaves a
// pit over its lowest pass.
Drainage *drainage_new(const HeightField *field, Error *e);
void drainage_free(Drainage *drainage); // NULL is fine

// Raises samples by the least that lets every one drain: each stands above its receiver by at
// least `fall` (a slope; 0 = by the smallest step that a float can make).
bool height_field_fill(HeightField *field, float fall, Error *e);

// Samples off the rim without a lower neighbour.
int64_t height_field_pits(const HeightField *field);

#endif
