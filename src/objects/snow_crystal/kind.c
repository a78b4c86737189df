// A snow crystal as a kind of object.
#include "objects/kind.h"
#include "objects/snow_crystal/snow_crystal.h"
#include "render/material/material.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    SnowCrystalParams *crystal = params;
    own_space_stand(own, crystal->position, crystal->rotation);
    crystal->position = crystal->rotation = vec3(0, 0, 0);
    return true;
}

// A flat crystal, or the cap at one end of a column.
static bool add_plate(const SnowCrystalParams *params, const Snowfake *fake, float height,
                      const Placing *placing, Error *e)
{
    Mesh *mesh = snow_crystal_mesh(params, fake, placing->recipe->seed, e);
    for (int64_t i = 0; mesh && i < mesh->vertex_count; i++) {
        mesh->position[i].y += height;
    }
    return mesh && placing_add(placing, (Part){.mesh = mesh}, 0, e);
}

static bool geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    const SnowCrystalParams *params = given;
    const Recipe *recipe = placing->recipe;
    SnowColumn column = snow_column(params);
    if (column.length > 0.0f) {
        Mesh *mesh = snow_column_mesh(params, &column, recipe->seed, e);
        if (!mesh || !placing_add(placing, (Part){.mesh = mesh}, 0, e)) {
            return false;
        }
        if (!(column.until < 1.0f)) {
            return true;
        }
    }
    Snowfake fake;
    if (!snow_crystal_grow(params, recipe->seed, recipe->run, &fake, e)) {
        return false;
    }
    float end = 0.5f * column.length;
    bool done = add_plate(params, &fake, end, placing, e) &&
                (end == 0.0f || add_plate(params, &fake, -end, placing, e));
    snowfake_clear(&fake);
    return done;
}

static bool measure(const void *given, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    (void)grown;
    const SnowCrystalParams *params = given;
    SnowColumn column = snow_column(params);
    if (column.length > 0.0f &&
        (!measures_add(list, "aspect", (double)(column.length / column.width), "", 1.0, 50.0, e) ||
         !measures_add(list, "hollow", (double)column.hollow, "", NAN, NAN, e))) {
        return false;
    }
    if (column.length > 0.0f && !(column.until < 1.0f)) {
        return true;
    }
    Snowfake fake;
    if (!snow_crystal_grow(given, recipe->seed, recipe->run, &fake, e)) {
        return false;
    }
    double fill = snowfake_fill(&fake), asymmetry = snowfake_asymmetry(&fake);
    snowfake_clear(&fake);
    return measures_add(list, "hexagon_fill", fill, "", 0.1, 1.0, e) &&
           measures_add(list, "asymmetry", asymmetry, "", 0.0, 0.25, e);
}

static void describe(const void *given, char *text, size_t size)
{
    const SnowCrystalParams *params = given;
    float until = snow_column_until(params);
    const char *form = until >= 1.0f ? ", a column" : until > 0.0f ? ", a capped column" : "";
    snprintf(text, size, ", %g mm%s", 1000.0 * (double)params->size, form);
    size_t used = strlen(text);
    if (until < 1.0f) {
        snprintf(text + used, size - used, ", %d cells to a tip", params->cells);
    }
}

static void needs(const void *given, Needs *needs)
{
    const SnowCrystalParams *params = given;
    float until = snow_column_until(params);
    if (until >= 1.0f) {
        return; // a few hundred faces
    }
    double plates = until > 0.0f ? 2.0 : 1.0;
    double points = (double)params->detail * (double)params->detail;
    double cell_bytes =
        2.8 * 2.8 * 21.0 + plates * points * 4.0 * (4.0 + 6.0 * 24.0); // lattice, then mesh
    needs_add(needs, "cells", (double)params->cells * (double)params->cells, cell_bytes);
}

static const Material BUILTIN[] = {
    {.name = "snow_crystal/ice",
     .kind = MATERIAL_DIELECTRIC,
     .color = {1.0f, 1.0f, 1.0f},
     .roughness = 0.0f,
     .ior = 1.31f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_snow_crystal = {
    .variant = {KIND_ROW("snow_crystal", &snow_crystal_table, "A snow crystal."), MATERIALS},
    .carried = true,
    .materials = {"snow_crystal/ice"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .geometry = geometry};
