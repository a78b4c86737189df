#include "animate/changes.h"

#include "base/memory.h"
#include "config/scalar.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void changes_clear(Changes *changes)
{
    for (int64_t i = 0; i < changes->count; i++) {
        free((char *)changes->item[i].path);
        free((char *)changes->item[i].value);
    }
    free(changes->item);
    *changes = (Changes){0};
}

bool changes_add(Changes *changes, const SceneChange *change, Error *e)
{
    if (!memory_reserve(&changes->item, &changes->capacity, changes->count + 1,
                        sizeof *changes->item, e)) {
        return false;
    }
    SceneChange copy = *change;
    copy.path = memory_copy_string(change->path, e);
    copy.value = memory_copy_string(change->value, e);
    if (!copy.path || !copy.value) {
        free((char *)copy.path);
        free((char *)copy.value);
        return false;
    }
    changes->item[changes->count++] = copy;
    return true;
}

bool changes_add_numbers(Changes *changes, const SceneChange *at, const double *value, int count,
                         Error *e)
{
    char text[1024];
    size_t used = 0;
    for (int i = 0; i < count; i++) {
        char number[32];
        scalar_from_double(value[i], number);
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s",
                                 i ? ", " : (count > 1 ? "[" : ""), number);
    }
    snprintf(text + used, sizeof text - used, "%s", count > 1 ? "]" : "");
    SceneChange change = *at;
    change.value = text;
    return changes_add(changes, &change, e);
}
