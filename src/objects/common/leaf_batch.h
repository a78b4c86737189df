// Leaves of one variant, collected for a part.
#ifndef RAMIFY_OBJECTS_COMMON_LEAF_BATCH_H
#define RAMIFY_OBJECTS_COMMON_LEAF_BATCH_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

typedef struct LeafBatch {
    Transform *instance;
    float *variation, *season; // see InstanceLook
    int64_t count, capacity, variation_capacity, season_capacity;
} LeafBatch;

bool leaf_batch_add(LeafBatch *batch, Transform instance, float variation, float season, Error *e);
void leaf_batch_clear(LeafBatch *batch);

#endif
