// A hollow branch sculpture as a kind of object.
#include "objects/kind.h"
#include "objects/sculpture/sculpture.h"
#include "outtree/join.h"

#include <math.h>
#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    SculptureParams *sculpture = params;
    own_space_of_element(own, &sculpture->element);
    return own_space_take_element(own, &sculpture->element, e);
}

static bool measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                    Error *e)
{
    (void)params, (void)recipe;
    double none = (double)NAN;
    int64_t pieces, loops;
    return out_tree_count_pieces(grown->tree, &pieces, &loops, e) &&
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
    .carried = true,
    .materials = {"clay"},
    .own_space = own_space,
    .keeps_clear = true,
    .contends = true,
    .needs = needs,
    .measure = measure,
    .describe = describe,
    .attractors = attractors,
    .grow = sculpture_grow,
    .geometry = sculpture_geometry};
