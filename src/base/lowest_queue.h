// A queue of numbered things that gives back the lowest first, ties by number: a binary heap.
#ifndef RAMIFY_BASE_LOWEST_QUEUE_H
#define RAMIFY_BASE_LOWEST_QUEUE_H

#include "base/error.h"

#include <stdint.h>

typedef struct QueueItem {
    float height;
    int32_t index;
} QueueItem;

// Zero is an empty queue. Release item with free().
typedef struct LowestQueue {
    QueueItem *item;
    int64_t count, capacity;
} LowestQueue;

bool lowest_queue_push(LowestQueue *queue, float height, int32_t index, Error *e);

// Takes the lowest out of a queue that is not empty.
QueueItem lowest_queue_pop(LowestQueue *queue);

#endif
