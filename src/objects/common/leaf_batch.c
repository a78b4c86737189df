#include "objects/common/leaf_batch.h"

#include "base/memory.h"

#include <stdlib.h>

bool leaf_batch_add(LeafBatch *batch, Transform instance, float variation, float season, Error *e)
{
    int64_t count = batch->count + 1;
    if (!memory_reserve(&batch->instance, &batch->capacity, count, sizeof *batch->instance, e) ||
        !memory_reserve(&batch->variation, &batch->variation_capacity, count,
                        sizeof *batch->variation, e) ||
        !memory_reserve(&batch->season, &batch->season_capacity, count, sizeof *batch->season, e)) {
        return false;
    }
    batch->instance[batch->count] = instance;
    batch->season[batch->count] = season;
    batch->variation[batch->count++] = variation;
    return true;
}

void leaf_batch_clear(LeafBatch *batch)
{
    free(batch->instance);
    free(batch->variation);
    free(batch->season);
    *batch = (LeafBatch){0};
}
