// Scattering as a kind of object.
#include "objects/scatter/scatter.h"

#include <stdio.h>

static const char *over(const void *params)
{
    const ScatteringParams *scatter = params;
    return scatter->on;
}

static const char *further_material(const void *params, int index)
{
    const ScatteringParams *scatter = params;
    return things_material(&scatter->things, index);
}

static void needs(const void *params, Needs *needs)
{
    const ScatteringParams *scatter = params;
    things_need(&scatter->things, scattering_most(scatter), needs);
}

static void describe(const void *params, char *text, size_t size)
{
    const ScatteringParams *scatter = params;
    snprintf(text, size, ", %lld copies of %d things on %s%s%s", (long long)scatter->count,
             scatter->things.count, scatter->on ? "'" : "the land", scatter->on ? scatter->on : "",
             scatter->on ? "'" : "");
}

static int64_t copies(const void *params)
{
    const ScatteringParams *scatter = params;
    return scattering_most(scatter);
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
