#include "base/lowest_queue.h"

#include "base/memory.h"

// Without branches, which could not be predicted.
static bool is_lower(QueueItem a, QueueItem b)
{
    return (a.height < b.height) | ((a.height == b.height) & (a.index < b.index));
}

// Children of an item: four are half as deep as two, and lie side by side in the cache.
enum { CHILDREN = 4 };

// Puts an item at place i or above it.
static void rise(LowestQueue *queue, int64_t i, QueueItem item)
{
    while (i > 0 && is_lower(item, queue->item[(i - 1) / CHILDREN])) {
        queue->item[i] = queue->item[(i - 1) / CHILDREN];
        i = (i - 1) / CHILDREN;
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
    for (; child + CHILDREN <= queue->count; child = CHILDREN * gap + 1) {
        int64_t a = child + is_lower(item[child + 1], item[child]);
        int64_t b = child + 2 + is_lower(item[child + 3], item[child + 2]);
        int64_t least = is_lower(item[b], item[a]) ? b : a;
        item[gap] = item[least];
        gap = least;
    }
    if (child < queue->count) {
        int64_t least = child;
        while (++child < queue->count) {
            least = is_lower(item[child], item[least]) ? child : least;
        }
        item[gap] = item[least];
        gap = least;
    }
    rise(queue, gap, last);
    return lowest;
}
