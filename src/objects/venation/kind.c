// A leaf and its veins as a kind of object.
#include "objects/kind.h"
#include "objects/venation/venation.h"
#include "render/material/material.h"

#include <stdio.h>
#include <string.h>

static void describe(const void *params, char *text, size_t size)
{
    const VenationParams *venation = params;
    snprintf(text, size, ", %s, %g m", venation->closed ? "closed" : "open",
             (double)venation->outline.length);
}

static void settle(const void *params, void *settled)
{
    VenationParams p = venation_params_resolve(params);
    memcpy(settled, &p, sizeof p);
}

static void needs(const void *params, Needs *needs)
{
    const VenationParams *venation = params;
    enum { MESH_BYTES = 500 }; // per mesh of the vein network, in a blade half as wide as long
    enum { FACE_BYTES = 450 }; // per quad of the blade, where the number of its rows is given
    double detail = venation->detail, rows = venation->blade ? venation->rows : 0;
    needs_add(needs, "detail", 0.4 * detail * detail, MESH_BYTES);
    needs_add(needs, "rows", 0.5 * rows * rows, FACE_BYTES);
}

static const Material BUILTIN[] = {
    // lignified: paler than the blade
    {.name = "leaf_vein",
     .kind = MATERIAL_LEAF,
     .color = {0.34f, 0.32f, 0.16f},
     .transmittance = {0.30f, 0.29f, 0.13f},
     .roughness = 0.6f,
     .specular = 0.3f,
     .ior = 1.5f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    LEAF_MATERIAL_ROW(1),
    {0},
};

const Kind kind_venation = {
    .variant = {KIND_ROW("venation", &venation_table, "A leaf and its veins."), MATERIALS},
    .materials = {"leaf_vein", "leaf"},
    .builtin = BUILTIN,
    .needs = needs,
    .describe = describe,
    .settle = settle,
    .grow = venation_grow,
    .finish = venation_finish,
    .geometry = venation_geometry,
    .paint = venation_paint,
    .measure = venation_measure};
