#include "base/lowest_queue.h"

#include "base/memory.h"

// Without branches, which could not be predicted.
static bool is_lower(QueueItem a, QueueItem b)
{
    return (a.height < b.height) | ((a.height == b.height) & (a.index < b.index));
}

// Puts an item at place i or above it.
static void rise(LowestQueue *queue, int64_t i, QueueItem item)
{
    while (i > 0 && is_lower(item, queue->item[(i - 1) / 2])) {
        queue->item[i] = queue->item[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    queue->item[i] = item;
}

bool lowest_queue_push(LowestQueue *queue, float height, int32_t index, Error *e)
{
    if (!memory_reserve(&queue->item, &queue->capacity, queue->count + 1, sizeof *queue->item, e)) {
        return false;
    }
    rise(queue, queue->count++, (QueueItem){height, index});
    return true;
}

// The gap sinks to the bottom, and the last item, which was there, seldom rises far from it.
QueueItem lowest_queue_pop(LowestQueue *queue)
{
    QueueItem *item = queue->item, lowest = item[0], last = item[--queue->count];
    int64_t gap = 0, child = 1;
    for (; child + 1 < queue->count; child = 2 * gap + 1) {
        child += is_lower(item[child + 1], item[child]);
        item[gap] = item[child];
        gap = child;
    }
    if (child < queue->count) {
        item[gap] = item[child];
        gap = child;
    }
    rise(queue, gap, last);
    return lowest;
}
