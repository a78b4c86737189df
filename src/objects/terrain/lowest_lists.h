// Which of many functions of a place can be lowest there: the square of the terrain is divided into
// leaves, and each lists its candidates, found by branch and bound. The lowest function is
// therefore exact everywhere, not sampled on a grid.
#ifndef RAMIFY_OBJECTS_TERRAIN_LOWEST_LISTS_H
#define RAMIFY_OBJECTS_TERRAIN_LOWEST_LISTS_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

// Bounds of function i within the distance r of (x, z).
typedef void LowestBounds(const void *functions, int32_t i, float x, float z, float r, float *low,
                          float *high);

typedef struct LowestLists LowestLists;

// Lists the `count` functions over the square of side `size` about the origin, each leaf those that
// can be lowest in it or within `margin` of it. Functions that lie above `most` are left out. Does
// not keep the functions. ERROR_MEMORY, ERROR_CANCELLED.
LowestLists *lowest_lists_new(LowestBounds *bounds, const void *functions, int64_t count,
                              float most, float size, float margin, const Run *run, Error *e);
void lowest_lists_free(LowestLists *lists); // NULL is fine

// The candidates at a place of the square (or up to margin beyond), in ascending order, and their
// number.
const int32_t *lowest_lists_at(const LowestLists *lists, float x, float z, int32_t *count);

#endif
