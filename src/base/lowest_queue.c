#include "base/lowest_queue.h"

#include "base/memory.h"

static bool is_lower(QueueItem a, QueueItem b)
{
    return a.height < b.height || (a.height == b.height && a.index < b.index);
}

bool lowest_queue_push(LowestQueue *queue, float height, int32_t index, Error *e)
{
    if (!memory_reserve(&queue->item, &queue->capacity, queue->count + 1, sizeof *queue->item, e)) {
        return false;
    }
    QueueItem item = {height, index};
    int64_t i = queue->count++;
    while (i > 0 && is_lower(item, queue->item[(i - 1) / 2])) {
        queue->item[i] = queue->item[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    queue->item[i] = item;
    return true;
}

QueueItem lowest_queue_pop(LowestQueue *queue)
{
    QueueItem lowest = queue->item[0], last = queue->item[--queue->count];
    int64_t i = 0;
    for (;;) {
        int64_t child = 2 * i + 1;
        if (child >= queue->count) {
            break;
        }
        if (child + 1 < queue->count && is_lower(queue->item[child + 1], queue->item[child])) {
            child++;
        }
        if (!is_lower(queue->item[child], last)) {
            break;
        }
        queue->item[i] = queue->item[child];
        i = child;
    }
    queue->item[i] = last;
    return lowest;
}
