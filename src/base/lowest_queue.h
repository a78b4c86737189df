// Priority queue of numbered items, lowest first, ties by number: a heap.
#ifndef RAMIFY_BASE_LOWEST_QUEUE_H
#define RAMIFY_BASE_LOWEST_QUEUE_H

#include "base/error.h"

#include <stdint.h>

typedef struct QueueItem {
    float height;
    int32_t index;
} QueueItem;

// Zero-initialised = empty. Release item with free().
typedef struct LowestQueue {
    QueueItem *item;
    int64_t count, capacity;
} LowestQueue;

bool lowest_queue_push(LowestQueue *queue, float height, int32_t index, Error *e);

// Removes the lowest item of a non-empty queue.
QueueItem lowest_queue_pop(LowestQueue *queue);

#endif
