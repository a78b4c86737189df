// A leaf and its veins as a kind of object.
#include "objects/venation/venation.h"
#include "scene/kinds.h"
#include "scene/spec.h"

#include <stdio.h>
#include <string.h>

static OutTree *grow(const void *params, const Recipe *recipe, Error *e)
{
    return venation_grow(params, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    VenationMaterials materials = {.vein = placing_material(p, 0), .blade = placing_material(p, 1)};
    return venation_geometry(tree, p->object->params, &materials, p->index, &p->world->geometry, e);
}

static bool paint(const void *params, const OutTree *tree, int width, int height, float *pixel,
                  Error *e)
{
    return venation_paint(tree, params, width, height, pixel, e);
}

static bool measure(const void *params, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    return venation_measure(tree, params, list, e);
}

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
    enum { MESH_BYTES = 500 }; // of the net of veins, in a blade half as wide as long
    double detail = venation->detail;
    needs_add(needs, "detail", 0.4 * detail * detail, MESH_BYTES);
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    LEAF_MATERIAL_ROW(1),
    {0},
};

const Kind kind_venation = {
    .variant = {KIND_ROW("venation", &venation_table, "A leaf and its veins."), MATERIALS},
    .materials = {"leaf_vein", "leaf"},
    .grow = grow,
    .needs = needs,
    .place = place,
    .measure = measure,
    .paint = paint,
    .describe = describe,
    .settle = settle};
