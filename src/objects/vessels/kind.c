// Blood vessels as a kind of object.
#include "objects/kind.h"
#include "objects/vessels/stem.h"
#include "objects/vessels/vessels.h"
#include "render/material/material.h"

#include <float.h>
#include <stdio.h>

// An inlet at the origin means the hilum, so one that is moved there is set slightly aside.
static Vec3 take_inlet(const OwnSpace *own, Vec3 inlet)
{
    if (!own->moved || vec3_dot(inlet, inlet) == 0.0f) {
        return inlet;
    }
    Vec3 mine = own_space_place(own, inlet);
    return vec3_dot(mine, mine) > 0.0f ? mine : vec3(FLT_MIN, 0, 0);
}

static bool take_great(OwnSpace *own, VesselsParams *vessels, Error *e)
{
    size_t size = (size_t)vessels->great_count * sizeof *vessels->great;
    vessels->great = size > 0 ? own_space_copy(own, vessels->great, size, e) : NULL;
    for (int i = 0; vessels->great && i < vessels->great_count; i++) {
        GreatVessel *great = &vessels->great[i];
        great->from = own_space_place(own, great->from);
        great->to = own_space_place(own, great->to);
        great->by = own_space_place(own, great->by);
    }
    return vessels->great || size == 0;
}

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    VesselsParams *vessels = params;
    own_space_of_element(own, &vessels->element);
    vessels->inlet = take_inlet(own, vessels->inlet);
    return take_great(own, vessels, e) && own_space_take_element(own, &vessels->element, e);
}

static bool measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    // Kassab et al. 1993; Huang et al. 1996.
    measures_set_range(list, "radius_exponent", 2.3, 3.0);
    measures_set_range(list, "branch_angle", 13.0, 43.0);
    measures_set_range(list, "horton_number", 3.3, 3.6);
    measures_set_range(list, "horton_radius", 1.5, 1.9);
    measures_set_range(list, "horton_length", 1.4, 2.2);
    return vessels_measure(params, grown, recipe, list, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const VesselsParams *vessels = params;
    snprintf(text, size, ", %lld terminals", (long long)vessels->terminals);
}

// The radius in an organ follows from its volume, which is not known before growth.
static void settle(const void *params, void *settled)
{
    const VesselsParams *vessels = params;
    const Shape *shape = &vessels->element.shapes[0];
    if (vessels->root_radius == 0.0f && shape->kind == SHAPE_BODY) {
        ((VesselsParams *)settled)->root_radius = vessels_aorta_radius(shape);
    }
}

static void flow(const void *params, FlowParams *flow)
{
    *flow = ((const VesselsParams *)params)->flow;
}

static void needs(const void *params, Needs *needs)
{
    const VesselsParams *vessels = params;
    enum { TERMINAL_BYTES = 1800 };
    needs_add(needs, "terminals", (double)vessels->terminals, TERMINAL_BYTES);
}

static const Material BUILTIN[] = {
    // Wet walls of vessels.
    {.name = "artery",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.45f, 0.022f, 0.016f},
     .color2 = {0.3f, 0.01f, 0.01f},
     .roughness = 0.28f,
     .specular = 0.6f,
     .ior = 1.5f},
    {.name = "vein",
     .kind = MATERIAL_PRINCIPLED,
     .color = {0.035f, 0.06f, 0.26f},
     .color2 = {0.02f, 0.03f, 0.15f},
     .roughness = 0.28f,
     .specular = 0.6f,
     .ior = 1.5f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    MATERIAL_ROW(1, "vein_material", "Material of veins; default: vein."),
    {0},
};

const Kind kind_vessels = {.variant = {KIND_ROW("vessels", &vessels_table,
                                                "Arteries and veins that fill an organ or a body."),
                                       MATERIALS},
                           .materials = {"artery", "vein"},
                           .builtin = BUILTIN,
                           .own_space = own_space,
                           .keeps_clear = true,
                           .settle = settle,
                           .needs = needs,
                           .flow = flow,
                           .measure = measure,
                           .describe = describe,
                           .grow = vessels_grow,
                           .finish = vessels_finish,
                           .geometry = vessels_geometry};
