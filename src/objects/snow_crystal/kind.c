// A snow crystal as a kind of object.
#include "objects/kind.h"
#include "objects/snow_crystal/snow_crystal.h"
#include "render/material/material.h"

#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    SnowCrystalParams *crystal = params;
    own_space_stand(own, crystal->position, crystal->rotation);
    crystal->position = crystal->rotation = vec3(0, 0, 0);
    return true;
}

static bool geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    (void)grown;
    Snowfake fake;
    if (!snow_crystal_grow(given, placing->recipe->seed, placing->recipe->run, &fake, e)) {
        return false;
    }
    Mesh *mesh = snow_crystal_mesh(given, &fake, e);
    snowfake_clear(&fake);
    return mesh && placing_add(placing, (Part){.mesh = mesh}, 0, e);
}

static bool measure(const void *given, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    (void)grown;
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
    snprintf(text, size, ", %g mm, %d cells to a tip", 1000.0 * (double)params->size,
             params->cells);
}

static void needs(const void *given, Needs *needs)
{
    const SnowCrystalParams *params = given;
    const double cell_bytes = 2.8 * 2.8 * 21.0 + 4.0 * (4.0 + 6.0 * 24.0); // lattice, then mesh
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
    .variant = {KIND_ROW("snow_crystal", &snow_crystal_table, "A flat snow crystal."), MATERIALS},
    .carried = true,
    .materials = {"snow_crystal/ice"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .geometry = geometry};
