// Frost as a kind of object.
#include "objects/kind.h"
#include "objects/frost/frost.h"
#include "render/material/material.h"

#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    FrostParams *frost = params;
    own_space_stand(own, frost->position, vec3(0, 0, 0));
    frost->position = vec3(0, 0, 0);
    size_t size = sizeof *frost->nucleus * (size_t)frost->nucleus_count;
    frost->nucleus = size > 0 ? own_space_copy(own, frost->nucleus, size, e) : NULL;
    for (int i = 0; frost->nucleus && i < frost->nucleus_count; i++) {
        frost->nucleus[i].position = own_space_place(own, frost->nucleus[i].position);
    }
    return frost->nucleus || size == 0;
}

static void describe(const void *params, char *text, size_t size)
{
    const FrostParams *frost = params;
    if (frost->surface == FROST_PANE) {
        snprintf(text, size, ", pane %g x %g m", (double)frost->width, (double)frost->height);
    } else {
        snprintf(text, size, ", bubble of radius %g m", (double)frost->radius);
    }
}

static int64_t attractors(const void *params)
{
    const FrostParams *frost = params;
    return frost->spines + frost->sides;
}

static int64_t copies(const void *params)
{
    const FrostParams *frost = params;
    return frost->grains;
}

static void needs(const void *params, Needs *needs)
{
    const FrostParams *frost = params;
    enum { SPINE_BYTES = 500, SIDE_BYTES = 2400, GRAIN_FACES = 20 }; // blades are meshes
    needs_add(needs, "spines", (double)frost->spines, SPINE_BYTES);
    needs_add(needs, "sides", (double)frost->sides, SIDE_BYTES);
    needs_add_copies(needs, "grains", 0.5 * (double)frost->grains, GRAIN_FACES);
}

static const Material BUILTIN[] = {
    // Ice: absorption after Picard et al. 2016. Rime is ice full of air.
    {.name = "ice",
     .kind = MATERIAL_DIELECTRIC,
     .color = {1.0f, 1.0f, 1.0f},
     .absorption = {0.25f, 0.05f, 0.02f},
     .roughness = 0.3f,
     .ior = 1.31f},
    {.name = "rime",
     .kind = MATERIAL_LEAF,
     .color = {0.44f, 0.45f, 0.46f},
     .transmittance = {0.48f, 0.49f, 0.50f},
     .roughness = 0.4f,
     .specular = 0.5f,
     .ior = 1.31f},
    {.name = "soap_film",
     .kind = MATERIAL_THIN_FILM,
     .color = {1.0f, 1.0f, 1.0f},
     .ior = 1.33f,
     .film_thickness = 480.0f,
     .film_drainage = 0.6f,
     .film_swirl = 0.35f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    RIME_MATERIAL_ROW(1),
    {0},
};

const Kind kind_frost = {
    .variant = {KIND_ROW("frost", &frost_table, "Frost on a window pane or a soap bubble."),
                MATERIALS},
    .materials = {"ice", "rime"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .keeps_clear = true,
    .contends = true,
    .needs = needs,
    .describe = describe,
    .attractors = attractors,
    .copies = copies,
    .grow = frost_grow,
    .finish = frost_finish,
    .geometry = frost_geometry,
    .measure = frost_measure};
