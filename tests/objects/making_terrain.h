// A terrain's heights and measures, without a scene.
#ifndef RAMIFY_TESTS_OBJECTS_MAKING_TERRAIN_H
#define RAMIFY_TESTS_OBJECTS_MAKING_TERRAIN_H

#include "objects/kinds.h"
#include "objects/terrain/internal.h"
#include "testing.h"

// The heights of a grown terrain; the caller frees them. threads: 0 = all. list, kept: NULL = not
// wanted; the caller clears *kept, which borrows params. Fails the test on an error.
static inline HeightField *make_heights(const TerrainParams *params, uint64_t seed, int threads,
                                        MeasureList *list, Grown *kept)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads > 0 ? threads : run.threads;
    Recipe recipe = {.seed = seed, .label = "land", .run = &run};
    Grown own, *grown = kept ? kept : &own;
    HeightField *field = NULL;
    if (kind_grow(&kind_terrain, params, &recipe, 1.0f, NULL, grown, &e)) {
        field = terrain_heights(params, grown, &run, &e);
    }
    if (!field || (list && !terrain_measure(params, grown, &recipe, list, &e))) {
        fail_msg("%s", e.message);
    }
    if (!kept) {
        grown_clear(grown);
    }
    return field;
}

static inline double measured(const MeasureList *list, const char *name)
{
    const Measure *measure = measures_find(list, name);
    assert_non_null(measure);
    return measure->value;
}

#endif
