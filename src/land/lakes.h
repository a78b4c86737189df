// Lakes: the hollows of a height field, each full to the lowest way out (priority flood, Barnes,
// Lehman and Mulla 2014), so that its surface is level and its depth is the land's own.
#ifndef RAMIFY_LAND_LAKES_H
#define RAMIFY_LAND_LAKES_H

#include "land/height_field.h"

typedef struct Lake {
    float level;             // m: the height of the outlet, to the bit
    float depth;             // m, of the deepest sample
    int64_t samples;         // under water
    double volume;           // m^3
    int columns[2], rows[2]; // of the samples under water: the first and the last
    int32_t outlet; // the sample over which it spills: the highest of the lowest way to the rim
} Lake;

typedef struct Lakes {
    int count;
    Lake *lake;     // owned; the largest area first, ties by the first sample
    int32_t *label; // owned: of each sample the number of its lake; -1 = none
} Lakes;

// Which hollows are lakes; others stay dry.
typedef struct LakeLimits {
    int count;    // at most so many, the largest; below 1 = all
    double area;  // m^2, least
    double depth; // m, least, of the deepest sample
} LakeLimits;

// Samples that are not finite count as outside. Free with lakes_free.
Lakes *lakes_find(const HeightField *field, const LakeLimits *limits, Error *e);
void lakes_free(Lakes *lakes); // NULL is fine

#endif
