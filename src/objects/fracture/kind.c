// A fractured body as a kind of object.
#include "objects/kind.h"
#include "objects/fracture/fracture.h"
#include "render/material/material.h"

#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    FractureParams *fracture = params;
    own_space_of_element(own, &fracture->element);
    return own_space_take_element(own, &fracture->element, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const FractureParams *fracture = params;
    snprintf(text, size, ", %d impacts", fracture->impacts);
}

static int64_t attractors(const void *params)
{
    const FractureParams *fracture = params;
    return fracture->element.level_count == 0 ? fracture->attractors
                                              : element_attractors(&fracture->element);
}

static void needs(const void *params, Needs *needs)
{
    const FractureParams *fracture = params;
    enum { VOXEL_BYTES = 900 }; // per voxel along the surfaces, old and new
    double voxels = fracture->resolution;
    needs_add(needs, "resolution", 6.0 * voxels * voxels, VOXEL_BYTES);
    needs_add_growth(needs, "attractors", (double)attractors(params));
}

static const Material BUILTIN[] = {
    // a fresh break in stone: paler and rougher than its weathered outside
    {.name = "broken",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.40f, 0.36f, 0.31f},
     .color2 = {0.26f, 0.23f, 0.20f},
     .roughness = 0.95f,
     .ior = 1.5f,
     .pattern = PATTERN_NOISE},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    MATERIAL_ROW(1, "inside_material", "Material of the broken faces; default: broken."),
    {0},
};

const Kind kind_fracture = {
    .variant = {KIND_ROW("fracture", &fracture_table, "A body broken along grown cracks."),
                MATERIALS},
    .materials = {"clay", "broken"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .needs = needs,
    .describe = describe,
    .attractors = attractors,
    .grow = fracture_grow,
    .geometry = fracture_geometry,
    .measure = fracture_measure};
