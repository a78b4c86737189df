#include "fit/misfit.h"

#include "base/memory.h"
#include "config/hint.h"
#include "scene/build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NOT_MEASURABLE 10.0 // half widths
#define FARTHEST 1e6        // the same, of a measure

static bool unknown_measure(const Scene *scene, const SceneTarget *target,
                            const MeasureList *measures, Error *e)
{
    const char *names[128];
    char hint[512];
    int count = 0;
    while (count < 128 && count < measures->count) {
        names[count] = measures->item[count].name;
        count++;
    }
    hint_format(target->measure, names, count, hint, sizeof hint);
    error_set(e, ERROR_INPUT, "targets: %s has no measure '%.60s'; %s", target->object,
              target->measure, count > 0 ? hint : "nothing of it can be measured");
    error_locate(e, scene->file, 0, 0);
    return false;
}

// The values of all targets that name object number index, from its measures.
static bool find_values(const Scene *scene, int index, const MeasureList *list, double *values,
                        Error *e)
{
    bool done = true;
    for (int i = 0; done && i < scene->target_count; i++) {
        const SceneTarget *target = &scene->targets[i];
        if (strcmp(target->object, scene->objects[index].name) == 0) {
            const Measure *measure = measures_find(list, target->measure);
            done = measure || unknown_measure(scene, target, list, e);
            values[i] = measure ? measure->value : 0.0;
        }
    }
    return done;
}

static bool is_named(const Scene *scene, const char *object)
{
    int i = 0;
    while (i < scene->target_count && strcmp(scene->targets[i].object, object) != 0) {
        i++;
    }
    return i < scene->target_count;
}

bool misfit_measure(const Scene *scene, const Run *run, double *values, Error *e)
{
    bool *named = memory_alloc_zero(scene->object_count, sizeof *named, e);
    MeasureList *list = memory_alloc_zero(scene->object_count, sizeof *list, e);
    bool done = named && list;
    for (int i = 0; done && i < scene->object_count; i++) {
        named[i] = is_named(scene, scene->objects[i].name);
    }
    done = done && scene_measure_objects(scene, named, run, list, e);
    for (int i = 0; list && i < scene->object_count; i++) {
        done = done && (!named[i] || find_values(scene, i, &list[i], values, e));
        measures_clear(&list[i]);
    }
    free(list);
    free(named);
    return done;
}

bool misfit_is_met(const SceneTarget *target, double value)
{
    return value >= target->low && value <= target->high;
}

static bool has_two_ends(const SceneTarget *target)
{
    return target->low > -TARGET_NO_BOUND && target->high < TARGET_NO_BOUND;
}

// The unit of distances from a range.
static double width_of(const SceneTarget *target)
{
    double end = target->low > -TARGET_NO_BOUND ? target->low : target->high;
    double width = has_two_ends(target) ? 0.5 * (target->high - target->low) : 0.0;
    if (width <= 0.0) { // one end, or both are the same number
        width = fabs(end);
    }
    return width > 0.0 ? width : 1.0;
}

double misfit_of(const SceneTarget *target, double value)
{
    double outside = value < target->low ? target->low - value : value - target->high;
    double e = isnan(value) ? NOT_MEASURABLE : outside / width_of(target);
    e = e > FARTHEST ? FARTHEST : e;
    return e > 0.0 ? e * e / (1.0 + e) : 0.0;
}

double misfit_from_middle(const SceneTarget *target, double value)
{
    if (!has_two_ends(target) || isnan(value)) {
        return 0.0;
    }
    double e = (value - 0.5 * (target->low + target->high)) / width_of(target);
    return e * e;
}
