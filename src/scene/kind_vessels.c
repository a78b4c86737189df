// Blood vessels as a kind of object.
#include "scene/kinds.h"

#include <float.h>
#include <stdio.h>

// An inlet at the origin stands for the hilum, so one that comes to lie there stays a little aside.
static Vec3 take_inlet(const OwnSpace *own, Vec3 inlet)
{
    if (!own->moved || vec3_dot(inlet, inlet) == 0.0f) {
        return inlet;
    }
    Vec3 mine = own_space_place(own, inlet);
    return vec3_dot(mine, mine) > 0.0f ? mine : vec3(FLT_MIN, 0, 0);
}

static bool own_space(OwnSpace *own, Error *e)
{
    VesselsParams *vessels = own_space_copy(own, own->object.vessels, sizeof *vessels, e);
    if (!vessels) {
        return false;
    }
    own->object.vessels = vessels;
    own_space_of_element(own, &vessels->element);
    vessels->inlet = take_inlet(own, vessels->inlet);
    return own_space_take_element(own, &vessels->element, e);
}

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

static void needs(const SceneObject *object, Needs *needs)
{
    enum { TERMINAL_BYTES = 1800 };
    needs_add(needs, "terminals", (double)object->vessels->terminals, TERMINAL_BYTES);
}

const Kind kind_vessels = {.key = "vessels",
                           .offset = offsetof(SceneObject, vessels),
                           .materials = {"material", "vein_material"},
                           .own_space = own_space,
                           .grow = grow,
                           .needs = needs,
                           .place = place,
                           .measure = measure,
                           .describe = describe};
