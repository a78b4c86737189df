// Frost as a kind of object.
#include "scene/kinds.h"

#include <stdio.h>

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

const Kind kind_frost = {.key = "frost",
                         .offset = offsetof(SceneObject, frost),
                         .materials = {"material", "rime_material"},
                         .grow = grow,
                         .place = place,
                         .measure = measure,
                         .describe = describe,
                         .attractors = attractors,
                         .copies = copies};
