// Lightning as a kind of object.
#include "base/color.h"
#include "objects/lightning/lightning.h"
#include "scene/kinds.h"

#include <stdio.h>
#include <string.h>

// A bolt stands at its strike; what crawls over a surface belongs to that.
static bool own_space(OwnSpace *own, Error *e)
{
    LightningParams *lightning = own_space_copy(own, own->object.lightning, sizeof *lightning, e);
    if (!lightning) {
        return false;
    }
    own->object.lightning = lightning;
    if (lightning->element.points.place == SCATTER_SURFACE) {
        own_space_of_element(own, &lightning->element);
    } else {
        own_space_stand(own, lightning->position, vec3(0, 0, 0));
    }
    lightning->position = own_space_place(own, lightning->position);
    lightning->lean_azimuth = own_space_azimuth(own, lightning->lean_azimuth);
    return own_space_take_element(own, &lightning->element, e);
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return lightning_grow(object->lightning, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    int material = placing_material(p, p->object->material, "lightning");
    float radiance = luminance(p->world->material[material].radiance);
    return lightning_geometry(tree, p->object->lightning, material, radiance, p->index,
                              &p->world->geometry, e);
}

static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    return lightning_measure(object->lightning, tree, list, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    if (object->lightning->element.points.place == SCATTER_SURFACE) {
        snprintf(text, size, ", over a surface");
    } else {
        snprintf(text, size, ", %g m", (double)object->lightning->height);
    }
}

static int64_t attractors(const SceneObject *object)
{
    return lightning_attractors(object->lightning);
}

static void settle(const SceneObject *object, void *params)
{
    LightningParams p = lightning_params_resolve(object->lightning);
    memcpy(params, &p, sizeof p);
}

static void needs(const SceneObject *object, Needs *needs)
{
    needs_add_growth(needs, "bolts", (double)attractors(object));
}

const Kind kind_lightning = {.key = "lightning",
                             .offset = offsetof(SceneObject, lightning),
                             .reads_scene = true,
                             .materials = {"material"},
                             .own_space = own_space,
                             .grow = grow,
                             .needs = needs,
                             .place = place,
                             .measure = measure,
                             .describe = describe,
                             .settle = settle,
                             .attractors = attractors};
