// Lists of trails.
#include "base/memory.h"
#include "objects/eruption/eruption.h"

#include <stdlib.h>

void trails_clear(Trails *t)
{
    free(t->point);
    free(t->first);
    *t = (Trails){0};
}

bool trails_begin(Trails *t, Error *e)
{
    if (!memory_reserve(&t->first, &t->first_capacity, t->trail_count + 2, sizeof *t->first, e)) {
        return false;
    }
    t->first[t->trail_count] = t->count;
    t->first[++t->trail_count] = t->count;
    return true;
}

bool trails_add(Trails *t, TrailPoint point, Error *e)
{
    if (!memory_reserve(&t->point, &t->capacity, t->count + 1, sizeof *t->point, e)) {
        return false;
    }
    t->point[t->count++] = point;
    t->first[t->trail_count] = t->count;
    return true;
}
