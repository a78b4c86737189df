// A hollow branch sculpture as a kind of object.
#include "objects/sculpture/sculpture.h"
#include "outtree/join.h"
#include "scene/kinds.h"
#include "scene/spec.h"

#include <math.h>
#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    SculptureParams *sculpture = params;
    own_space_of_element(own, &sculpture->element);
    return own_space_take_element(own, &sculpture->element, e);
}

static OutTree *grow(const void *params, const Recipe *recipe, Error *e)
{
    return sculpture_grow(params, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    return sculpture_geometry(tree, placing_material(p, 0), p->index, &p->world->geometry,
                              p->recipe.run, e);
}

static bool measure(const void *params, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    (void)params;
    double none = (double)NAN;
    int64_t pieces, loops;
    return out_tree_count_pieces(tree, &pieces, &loops, e) &&
           measures_add(list, "pieces", (double)pieces, "", 1.0, 1.0, e) &&
           measures_add(list, "loops", (double)loops, "", none, none, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const SculptureParams *sculpture = params;
    snprintf(text, size, ", %d clusters", sculpture->clusters);
}

static int64_t attractors(const void *params)
{
    const SculptureParams *sculpture = params;
    return sculpture->element.level_count == 0 ? sculpture->attractors
                                               : element_attractors(&sculpture->element);
}

static void needs(const void *params, Needs *needs)
{
    enum { ATTRACTOR_BYTES = 150000 }; // of bars through a level set
    needs_add(needs, "attractors", (double)attractors(params), ATTRACTOR_BYTES);
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    {0},
};

const Kind kind_sculpture = {
    .variant = {KIND_ROW("sculpture", &sculpture_table, "A hollow branch sculpture."), MATERIALS},
    .materials = {"clay"},
    .own_space = own_space,
    .grow = grow,
    .needs = needs,
    .place = place,
    .measure = measure,
    .describe = describe,
    .attractors = attractors};
