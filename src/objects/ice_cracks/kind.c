// Cracks in ice as a kind of object.
#include "objects/kind.h"
#include "objects/ice_cracks/ice_cracks.h"
#include "render/material/material.h"

#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    IceCracksParams *cracks = params;
    own_space_stand(own, cracks->position, cracks->rotation);
    cracks->position = cracks->rotation = vec3(0, 0, 0);
    return true;
}

static void describe(const void *params, char *text, size_t size)
{
    const IceCracksParams *cracks = params;
    snprintf(text, size, ", %g m apart over %g m", (double)cracks->spacing, (double)cracks->size);
}

static void settle(const void *params, void *settled)
{
    IceCracksParams *cracks = settled;
    *cracks = *(const IceCracksParams *)params;
    cracks->grain = ice_cracks_grain(cracks);
}

static void needs(const void *params, Needs *needs)
{
    enum { FACE_BYTES = 120, MEAN_DEPTH_PERCENT = 60 };
    const IceCracksParams *cracks = params;
    double grain = (double)ice_cracks_grain(cracks), size = (double)cracks->size;
    double length = 1.5 * size * size / (double)cracks->spacing;
    double area = length * (double)cracks->depth * MEAN_DEPTH_PERCENT / 100;
    needs_add(needs, "grain", 2.0 * area / (grain * grain), FACE_BYTES);
}

static const Material BUILTIN[] = {
    // A film of air in ice: most light is thrown back by its rough walls, the rest goes through.
    {.name = "ice_cracks/air",
     .kind = MATERIAL_LEAF,
     .color = {0.55f, 0.57f, 0.59f},
     .transmittance = {0.34f, 0.36f, 0.37f},
     .roughness = 0.4f,
     .specular = 0.3f,
     .ior = 1.31f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_ice_cracks = {
    .variant = {KIND_ROW("ice_cracks", &ice_cracks_table, "Cracks in a sheet of clear ice."),
                MATERIALS},
    .materials = {"ice_cracks/air"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .needs = needs,
    .settle = settle,
    .describe = describe,
    .grow = ice_cracks_grow,
    .geometry = ice_cracks_geometry,
    .measure = ice_cracks_measure};
