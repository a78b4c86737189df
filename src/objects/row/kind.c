// A row as a kind of object.
#include "objects/row/row.h"

#include <stdio.h>

static const char *over(const void *params)
{
    const RowParams *row = params;
    return row->on;
}

static const char *further_material(const void *params, int index)
{
    const RowParams *row = params;
    return things_material(&row->things, index);
}

static void needs(const void *params, Needs *needs)
{
    const RowParams *row = params;
    things_need(&row->things, row_count(row), needs);
}

static void describe(const void *params, char *text, size_t size)
{
    const RowParams *row = params;
    snprintf(text, size, ", %lld copies of %d things in a row", (long long)row_count(row),
             row->things.count);
}

static int64_t copies(const void *params)
{
    return row_count(params);
}

static bool row_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const RowParams *params = given;
    ThingPlaces places;
    bool done = row_places_init(&places, params, placing->recipe, &placing->around, e) &&
                things_geometry(&params->things, &places, placing, e);
    thing_places_free(&places);
    return done;
}

static const Key NO_MATERIALS[] = {{0}};

const Kind kind_row = {
    .variant = {KIND_ROW("row", &row_table,
                         "Copies of any objects along a line: a fence, a jetty, an avenue."),
                NO_MATERIALS},
    .materials = {"clay"},
    .further_material = further_material,
    .reads_scene = true, // the land
    .over = over,
    .over_key = "on",
    .needs = needs,
    .describe = describe,
    .copies = copies,
    .geometry = row_geometry};
