// A frost flower as a kind of object.
#include "objects/kind.h"
#include "objects/frost_flower/frost_flower.h"
#include "render/material/material.h"

#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    FrostFlowerParams *flower = params;
    own_space_stand(own, flower->position, flower->rotation);
    flower->position = flower->rotation = vec3(0, 0, 0);
    return true;
}

static void describe(const void *params, char *text, size_t size)
{
    const FrostFlowerParams *flower = params;
    snprintf(text, size, ", %g mm, %d feathers", 1000.0 * (double)flower->size, flower->feathers);
}

static void needs(const void *params, Needs *needs)
{
    const FrostFlowerParams *flower = params;
    double barbs = (double)flower->barbs, bytes = 1600.0 * 2.0 * barbs * 0.9;
    for (int k = 1; k < flower->orders; k++) {
        bytes *= 0.35 * barbs; // sides of each side, mean
    }
    needs_add(needs, "feathers", (double)flower->feathers, bytes);
}

static const Material BUILTIN[] = {
    // Ice: absorption after Picard et al. 2016. Rime is ice full of air.
    {.name = "frost_flower/ice",
     .kind = MATERIAL_DIELECTRIC,
     .color = {1.0f, 1.0f, 1.0f},
     .absorption = {0.25f, 0.05f, 0.02f},
     .roughness = 0.15f,
     .ior = 1.31f},
    {.name = "frost_flower/rime",
     .kind = MATERIAL_LEAF,
     .color = {0.46f, 0.47f, 0.48f},
     .transmittance = {0.47f, 0.48f, 0.49f},
     .roughness = 0.3f,
     .specular = 0.5f,
     .ior = 1.31f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    RIME_MATERIAL_ROW(1),
    {0},
};

const Kind kind_frost_flower = {.variant = {KIND_ROW("frost_flower", &frost_flower_table,
                                                     "A flower of frost feathers on new ice."),
                                            MATERIALS},
                                .materials = {"frost_flower/ice", "frost_flower/rime"},
                                .builtin = BUILTIN,
                                .own_space = own_space,
                                .needs = needs,
                                .describe = describe,
                                .grow = frost_flower_grow,
                                .finish = frost_flower_finish,
                                .geometry = frost_flower_geometry,
                                .measure = frost_flower_measure};
