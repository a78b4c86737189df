// Frost as a kind of object.
#include "scene/kinds.h"

#include <stdio.h>

static bool own_space(OwnSpace *own, Error *e)
{
    FrostParams *frost = own_space_copy(own, own->object.frost, sizeof *frost, e);
    if (!frost) {
        return false;
    }
    own->object.frost = frost;
    own_space_stand(own, frost->position, vec3(0, 0, 0));
    frost->position = vec3(0, 0, 0);
    size_t size = sizeof *frost->nucleus * (size_t)frost->nucleus_count;
    frost->nucleus = size > 0 ? own_space_copy(own, frost->nucleus, size, e) : NULL;
    for (int i = 0; frost->nucleus && i < frost->nucleus_count; i++) {
        frost->nucleus[i].position = own_space_place(own, frost->nucleus[i].position);
    }
    return frost->nucleus || size == 0;
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return frost_grow(object->frost, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    FrostMaterials materials = {.ice = placing_material(p, p->object->material, "ice"),
                                .rime = placing_material(p, p->object->rime_material, "rime")};
    return frost_geometry(tree, p->object->frost, &materials, p->index, &p->recipe,
                          &p->world->geometry, e);
}

static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    return frost_measure(tree, object->frost, list, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    const FrostParams *frost = object->frost;
    if (frost->surface == FROST_PANE) {
        snprintf(text, size, ", pane %g x %g m", (double)frost->width, (double)frost->height);
    } else {
        snprintf(text, size, ", bubble of radius %g m", (double)frost->radius);
    }
}

static int64_t attractors(const SceneObject *object)
{
    return object->frost->spines + object->frost->sides;
}

static int64_t copies(const SceneObject *object)
{
    return object->frost->grains;
}

static void needs(const SceneObject *object, Needs *needs)
{
    enum { SPINE_BYTES = 500, SIDE_BYTES = 2400, GRAIN_FACES = 20 }; // blades are meshes
    needs_add(needs, "spines", (double)object->frost->spines, SPINE_BYTES);
    needs_add(needs, "sides", (double)object->frost->sides, SIDE_BYTES);
    needs_add_copies(needs, "grains", 0.5 * (double)object->frost->grains, GRAIN_FACES);
}

const Kind kind_frost = {.key = "frost",
                         .offset = offsetof(SceneObject, frost),
                         .materials = {"material", "rime_material"},
                         .own_space = own_space,
                         .grow = grow,
                         .needs = needs,
                         .place = place,
                         .measure = measure,
                         .describe = describe,
                         .attractors = attractors,
                         .copies = copies};
