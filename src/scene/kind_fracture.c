// A broken thing as a kind of object.
#include "scene/kinds.h"

#include <stdio.h>

static bool own_space(OwnSpace *own, Error *e)
{
    FractureParams *fracture = own_space_copy(own, own->object.fracture, sizeof *fracture, e);
    if (!fracture) {
        return false;
    }
    own->object.fracture = fracture;
    own_space_of_element(own, &fracture->element);
    return own_space_take_element(own, &fracture->element, e);
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return fracture_grow(object->fracture, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    const SceneObject *object = p->object;
    FractureMaterials materials = {.outside = placing_material(p, object->material, "clay"),
                                   .inside =
                                       placing_material(p, object->inside_material, "broken")};
    return fracture_geometry(tree, object->fracture, &materials, p->index, &p->recipe,
                             &p->world->geometry, e);
}

static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    return fracture_measure(tree, object->fracture, recipe, list, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %d impacts", object->fracture->impacts);
}

static int64_t attractors(const SceneObject *object)
{
    const FractureParams *params = object->fracture;
    return params->element.level_count == 0 ? params->attractors
                                            : element_attractors(&params->element);
}

static void needs(const SceneObject *object, Needs *needs)
{
    enum { VOXEL_BYTES = 900 }; // of one along the surfaces, old and new
    double voxels = object->fracture->resolution;
    needs_add(needs, "resolution", 6.0 * voxels * voxels, VOXEL_BYTES);
    needs_add_growth(needs, "attractors", (double)attractors(object));
}

const Kind kind_fracture = {.key = "fracture",
                            .offset = offsetof(SceneObject, fracture),
                            .materials = {"material", "inside_material"},
                            .own_space = own_space,
                            .grow = grow,
                            .needs = needs,
                            .place = place,
                            .measure = measure,
                            .describe = describe,
                            .attractors = attractors};
