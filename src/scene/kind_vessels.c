// Blood vessels as a kind of object.
#include "scene/kinds.h"

#include <stdio.h>

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return vessels_grow(object->vessels, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    VesselsMaterials materials = {.artery = placing_material(p, p->object->material, "artery"),
                                  .vein = placing_material(p, p->object->vein_material, "vein")};
    return vessels_geometry(tree, p->object->vessels, &materials, p->index, &p->world->geometry,
                            p->recipe.run, e);
}

static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    // Kassab et al. 1993; Huang et al. 1996.
    measures_set_range(list, "radius_exponent", 2.3, 3.0);
    measures_set_range(list, "branch_angle", 13.0, 43.0);
    measures_set_range(list, "horton_number", 3.3, 3.6);
    measures_set_range(list, "horton_radius", 1.5, 1.9);
    measures_set_range(list, "horton_length", 1.4, 2.2);
    return vessels_measure(tree, object->vessels, list, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %lld terminals", (long long)object->vessels->terminals);
}

const Kind kind_vessels = {.key = "vessels",
                           .offset = offsetof(SceneObject, vessels),
                           .materials = {"material", "vein_material"},
                           .grow = grow,
                           .place = place,
                           .measure = measure,
                           .describe = describe};
