#include "base/measures.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool measures_add(MeasureList *list, const char *name, double value, const char *unit, double low,
                  double high, Error *e)
{
    if (!memory_reserve(&list->item, &list->capacity, list->count + 1, sizeof *list->item, e)) {
        return false;
    }
    Measure *measure = &list->item[list->count++];
    *measure = (Measure){.value = value, .unit = unit, .low = low, .high = high};
    snprintf(measure->name, sizeof measure->name, "%s", name);
    return true;
}

const Measure *measures_find(const MeasureList *list, const char *name)
{
    for (int64_t i = 0; i < list->count; i++) {
        if (strcmp(list->item[i].name, name) == 0) {
            return &list->item[i];
        }
    }
    return NULL;
}

void measures_set_range(MeasureList *list, const char *name, double low, double high)
{
    for (int64_t i = 0; i < list->count; i++) {
        if (strcmp(list->item[i].name, name) == 0) {
            list->item[i].low = low;
            list->item[i].high = high;
        }
    }
}

void measures_clear(MeasureList *list)
{
    free(list->item);
    *list = (MeasureList){0};
}
