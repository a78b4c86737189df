// An eruption as a kind of object.
#include "objects/kind.h"
#include "objects/eruption/eruption.h"
#include "render/material/material.h"

#include <stdio.h>

static const char *over(const void *params)
{
    const EruptionParams *p = params;
    return p->on;
}

static void describe(const void *params, char *text, size_t size)
{
    const EruptionParams *p = params;
    snprintf(text, size, ", %d bombs, %d streams of lava", p->bombs, p->stream_count);
}

static void needs(const void *params, Needs *needs)
{
    enum { BOMB_BYTES = 6000, STREAM_BYTES = 60 };
    const EruptionParams *p = params;
    double area = 0.0; // m^2
    for (int i = 0; i < p->stream_count; i++) {
        const LavaStream *s = &p->stream[i];
        area += (double)s->width * (double)s->length * s->branches;
    }
    needs_add(needs, "bombs", (double)p->bombs, BOMB_BYTES);
    needs_add(needs, "streams", area, STREAM_BYTES);
}

// Hues of black bodies of about 1,400, 1,250 and 1,100 K; brightness is eruption.radiance.
static const Material BUILTIN[] = {
    {.name = "eruption/hot", .kind = MATERIAL_EMISSION, .radiance = {1.0f, 0.22f, 0.018f}},
    {.name = "eruption/warm", .kind = MATERIAL_EMISSION, .radiance = {1.0f, 0.13f, 0.007f}},
    {.name = "eruption/dull", .kind = MATERIAL_EMISSION, .radiance = {1.0f, 0.065f, 0.002f}},
    {.name = "eruption/crust",
     .kind = MATERIAL_DIFFUSE,
     .color = {0.035f, 0.032f, 0.030f},
     .roughness = 1.0f},
    {.name = ""},
};

static const Key MATERIALS[] = {
    MATERIAL_ROW(0, "hot_material", "Material of the hottest lava; default: eruption/hot."),
    MATERIAL_ROW(1, "warm_material",
                 "Material of lava 120 degrees cooler; default: eruption/warm."),
    MATERIAL_ROW(2, "dull_material",
                 "Material of lava 260 degrees cooler; default: eruption/dull."),
    MATERIAL_ROW(3, "crust_material", "Material of the crust's rubble; default: eruption/crust."),
    {0},
};

const Kind kind_eruption = {
    .variant = {KIND_ROW("eruption", &eruption_table,
                         "What glows on an erupting volcano: bombs and streams of lava."),
                MATERIALS},
    .materials = {"eruption/hot", "eruption/warm", "eruption/dull", "eruption/crust"},
    .builtin = BUILTIN,
    .reads_scene = true,
    .over = over,
    .over_key = "on",
    .needs = needs,
    .describe = describe,
    .geometry = eruption_geometry};
