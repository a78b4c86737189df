#include "api/handles.h"

#include "base/memory.h"
#include "land/height_measure.h"
#include "outtree/measure.h"

#include <stdlib.h>

static void free_list(MeasureList *list)
{
    if (list) {
        measures_clear(list);
        free(list);
    }
}

// Returns the list if filled; else frees it and sets the error.
static RamifyMeasures *hand_list(MeasureList *list, bool filled, const Error *e, RamifyError *error)
{
    if (!filled) {
        free_list(list);
        api_fail(error, e);
        return NULL;
    }
    return (RamifyMeasures *)(void *)list;
}

static MeasureList *new_list(Error *e)
{
    return memory_alloc_zero(1, sizeof(MeasureList), e);
}

RamifyMeasures *ramify_measure(const RamifyScene *scene, int index, const RamifyRun *run,
                               RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    MeasureList *list = new_list(&e);
    bool filled = list && api_check_object(scene, index, &e) &&
                  scene_measure(scene_of(scene), index, &own, list, &e);
    return hand_list(list, filled, &e, error);
}

bool ramify_measure_objects(const RamifyScene *scene, const bool *wanted, RamifyMeasures **measures,
                            const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    int count = scene_of(scene)->object_count;
    MeasureList *lists = memory_alloc_zero(count, sizeof *lists, &e);
    bool done = lists && scene_measure_objects(scene_of(scene), wanted, &own, lists, &e);
    for (int i = 0; i < count; i++) {
        bool hand = done && (!wanted || wanted[i]);
        MeasureList *list = hand ? new_list(&e) : NULL;
        done = done && (list || !hand);
        if (list) {
            *list = lists[i];
        } else if (lists) {
            measures_clear(&lists[i]);
        }
        measures[i] = (RamifyMeasures *)(void *)list;
    }
    free(lists);
    for (int i = 0; !done && i < count; i++) {
        ramify_measures_free(measures[i]);
        measures[i] = NULL;
    }
    return done || api_fail(error, &e);
}

RamifyMeasures *ramify_tree_measure(const RamifyTree *tree, RamifyError *error)
{
    Error e = {0};
    MeasureList *list = new_list(&e);
    return hand_list(list, list && out_tree_measure(tree_of(tree), list, &e), &e, error);
}

RamifyMeasures *ramify_land_measure(const RamifyLand *land, RamifyError *error)
{
    Error e = {0};
    MeasureList *list = new_list(&e);
    return hand_list(list, list && height_field_measure(land_of(land), 0.0, list, &e), &e, error);
}

void ramify_measures_free(RamifyMeasures *measures)
{
    free_list((MeasureList *)(void *)measures);
}

int ramify_measures_count(const RamifyMeasures *measures)
{
    return (int)measures_of(measures)->count;
}

void ramify_measures_get(const RamifyMeasures *measures, int index, RamifyMeasure *measure)
{
    const Measure *own = &measures_of(measures)->item[index];
    *measure = (RamifyMeasure){.name = own->name,
                               .unit = own->unit,
                               .value = own->value,
                               .low = own->low,
                               .high = own->high};
}

int ramify_measures_find(const RamifyMeasures *measures, const char *name)
{
    const MeasureList *list = measures_of(measures);
    const Measure *found = measures_find(list, name);
    return found ? (int)(found - list->item) : -1;
}
