// Lightning as a kind of object.
#include "objects/kind.h"
#include "base/color.h"
#include "objects/lightning/lightning.h"
#include "render/material/material.h"

#include <stdio.h>
#include <string.h>

// Origin at the strike; on a surface, at that of the envelope.
static bool own_space(OwnSpace *own, void *params, Error *e)
{
    LightningParams *lightning = params;
    if (lightning->element.points.place == SCATTER_SURFACE) {
        own_space_of_element(own, &lightning->element);
    } else {
        own_space_stand(own, lightning->position, vec3(0, 0, 0));
    }
    lightning->position = own_space_place(own, lightning->position);
    lightning->lean_azimuth = own_space_azimuth(own, lightning->lean_azimuth);
    return own_space_take_element(own, &lightning->element, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const LightningParams *lightning = params;
    if (lightning->element.points.place == SCATTER_SURFACE) {
        snprintf(text, size, ", over a surface");
    } else {
        snprintf(text, size, ", %g m", (double)lightning->height);
    }
}

static int64_t attractors(const void *params)
{
    return lightning_attractors(params);
}

static void settle(const void *params, void *settled)
{
    LightningParams p = lightning_params_resolve(params);
    memcpy(settled, &p, sizeof p);
}

static void needs(const void *params, Needs *needs)
{
    needs_add_growth(needs, "bolts", (double)attractors(params));
}

static const Material BUILTIN[] = {
    // The hue of nitrogen at 30,000 K; brightness is lightning.power.
    {.name = "lightning", .kind = MATERIAL_EMISSION, .radiance = {0.75f, 0.85f, 1.25f}},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_lightning = {
    .variant = {KIND_ROW("lightning", &lightning_table,
                         "Bolts in the air, or discharges over a surface."),
                MATERIALS},
    .reads_scene = true,
    .carried = true,
    .materials = {"lightning"},
    .builtin = BUILTIN,
    .own_space = own_space,
    .needs = needs,
    .describe = describe,
    .settle = settle,
    .attractors = attractors,
    .grow = lightning_grow,
    .finish = lightning_finish,
    .geometry = lightning_geometry,
    .measure = lightning_measure};
