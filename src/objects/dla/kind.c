// A diffusion-limited aggregate as a kind of object.
#include "objects/kind.h"
#include "grow/aggregate/dla.h"
#include "objects/dla/dla.h"
#include "render/material/material.h"

#include <math.h>
#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    DlaModel *dla = params;
    own_space_stand(own, dla->position, dla->rotation);
    dla->position = dla->rotation = vec3(0, 0, 0);
    return true;
}

// 1.71 and 2.5 for ever larger clusters (Meakin 1983; Davidovitch et al. 2000).
static bool measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    const DlaModel *dla = params;
    (void)recipe;
    double dimension = dla_dimension(grown->tree), low = dla->dimension == 2 ? 1.66 : 2.4;
    return measures_add(list, "gyration_dimension", dimension > 0.0 ? dimension : (double)NAN, "",
                        low, low + 0.2, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const DlaModel *dla = params;
    snprintf(text, size, ", %lld particles in %dD", (long long)dla->particles, dla->dimension);
}

static void needs(const void *params, Needs *needs)
{
    const DlaModel *dla = params;
    enum { PARTICLE_BYTES = 20000 }; // of the level set per particle, at the least thickness
    needs_add(needs, "particles", (double)dla->particles, PARTICLE_BYTES);
}

static const Material BUILTIN[] = {
    // reflectance of copper at normal incidence, linear Rec. 709
    {.name = "copper",
     .kind = MATERIAL_CONDUCTOR,
     .color = {0.955f, 0.638f, 0.538f},
     .color2 = {0.1f, 0.1f, 0.1f},
     .roughness = 0.35f,
     .ior = 1.5f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_dla = {
    .variant = {KIND_ROW("dla", &dla_table,
                         "A metal dendrite, grown by diffusion-limited aggregation."),
                MATERIALS},
    .carried = true,
    .materials = {"copper"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .grow = dla_model_grow,
    .finish = dla_model_finish,
    .geometry = dla_model_geometry};
