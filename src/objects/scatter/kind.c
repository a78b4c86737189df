// Scattering as a kind of object.
#include "objects/scatter/scatter.h"

#include <stdio.h>

static const char *over(const void *params)
{
    const ScatteringParams *scatter = params;
    return scatter->on;
}

// A thing's materials, OBJECT_MOST_MATERIALS of each, by its kind's roles.
static const char *further_material(const void *params, int index)
{
    const ScatteringParams *scatter = params;
    int number = index / OBJECT_MOST_MATERIALS, role = index % OBJECT_MOST_MATERIALS;
    if (number >= scatter->thing_count) {
        return NULL;
    }
    const SceneObject *object = &scatter->things[number].object;
    const char *given = object->material[role],
               *own = kind_material(object->kind, object->params, role);
    const char *first =
        object->material[0] ? object->material[0] : kind_material(object->kind, object->params, 0);
    return given ? given : own ? own : first;
}

static void needs(const void *params, Needs *needs)
{
    enum { PARTS = 4 };
    const ScatteringParams *scatter = params;
    for (int i = 0; i < scatter->thing_count; i++) {
        const SceneObject *object = &scatter->things[i].object;
        for (int v = 0; object->kind->needs && v < scatter->variants; v++) {
            object->kind->needs(object->params, needs);
        }
    }
    needs_add_groups(needs, "count", (double)scatter->count, PARTS);
}

static void describe(const void *params, char *text, size_t size)
{
    const ScatteringParams *scatter = params;
    snprintf(text, size, ", %lld copies of %d things on %s%s%s", (long long)scatter->count,
             scatter->thing_count, scatter->on ? "'" : "the land", scatter->on ? scatter->on : "",
             scatter->on ? "'" : "");
}

static int64_t copies(const void *params)
{
    const ScatteringParams *scatter = params;
    return scatter->count;
}

static const Key NO_MATERIALS[] = {{0}};

const Kind kind_scatter = {
    .variant = {KIND_ROW("scatter", &scatter_table,
                         "Copies of any objects over the land or another object."),
                NO_MATERIALS},
    .materials = {"clay"},
    .further_material = further_material,
    .reads_scene = true, // the land
    .reads_water = true,
    .over = over,
    .over_key = "on",
    .needs = needs,
    .describe = describe,
    .copies = copies,
    .geometry = scatter_geometry};
