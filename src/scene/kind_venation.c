// A leaf and its veins as a kind of object.
#include "scene/kinds.h"

#include <stdio.h>
#include <string.h>

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return venation_grow(object->venation, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    VenationMaterials materials = {.vein = placing_material(p, p->object->material, "leaf_vein"),
                                   .blade = placing_material(p, p->object->leaf_material, "leaf")};
    return venation_geometry(tree, p->object->venation, &materials, p->index, &p->world->geometry,
                             e);
}

static bool paint(const SceneObject *object, const OutTree *tree, int width, int height,
                  float *pixel, Error *e)
{
    return venation_paint(tree, object->venation, width, height, pixel, e);
}

static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    return venation_measure(tree, object->venation, list, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %s, %g m", object->venation->closed ? "closed" : "open",
             (double)object->venation->outline.length);
}

static void settle(const SceneObject *object, void *params)
{
    VenationParams p = venation_params_resolve(object->venation);
    memcpy(params, &p, sizeof p);
}

static void needs(const SceneObject *object, Needs *needs)
{
    enum { MESH_BYTES = 500 }; // of the net of veins, in a blade half as wide as long
    double detail = object->venation->detail;
    needs_add(needs, "detail", 0.4 * detail * detail, MESH_BYTES);
}

const Kind kind_venation = {.key = "venation",
                            .offset = offsetof(SceneObject, venation),
                            .materials = {"material", "leaf_material"},
                            .grow = grow,
                            .needs = needs,
                            .place = place,
                            .measure = measure,
                            .paint = paint,
                            .describe = describe,
                            .settle = settle};
