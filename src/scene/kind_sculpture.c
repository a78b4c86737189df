// A hollow branch sculpture as a kind of object.
#include "outtree/join.h"
#include "scene/kinds.h"

#include <math.h>
#include <stdio.h>

static bool own_space(OwnSpace *own, Error *e)
{
    SculptureParams *sculpture = own_space_copy(own, own->object.sculpture, sizeof *sculpture, e);
    if (!sculpture) {
        return false;
    }
    own->object.sculpture = sculpture;
    own_space_of_element(own, &sculpture->element);
    return own_space_take_element(own, &sculpture->element, e);
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return sculpture_grow(object->sculpture, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    return sculpture_geometry(tree, placing_material(p, p->object->material, "clay"), p->index,
                              &p->world->geometry, p->recipe.run, e);
}

static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    (void)object;
    double none = (double)NAN;
    int64_t pieces, loops;
    return out_tree_count_pieces(tree, &pieces, &loops, e) &&
           measures_add(list, "pieces", (double)pieces, "", 1.0, 1.0, e) &&
           measures_add(list, "loops", (double)loops, "", none, none, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %d clusters", object->sculpture->clusters);
}

static int64_t attractors(const SceneObject *object)
{
    const SculptureParams *params = object->sculpture;
    return params->element.level_count == 0 ? params->attractors
                                            : element_attractors(&params->element);
}

static void needs(const SceneObject *object, Needs *needs)
{
    enum { ATTRACTOR_BYTES = 150000 }; // of bars through a level set
    needs_add(needs, "attractors", (double)attractors(object), ATTRACTOR_BYTES);
}

const Kind kind_sculpture = {.key = "sculpture",
                             .offset = offsetof(SceneObject, sculpture),
                             .materials = {"material"},
                             .own_space = own_space,
                             .grow = grow,
                             .needs = needs,
                             .place = place,
                             .measure = measure,
                             .describe = describe,
                             .attractors = attractors};
