// Plants written as L-systems as a kind of object.
#include "objects/kind.h"
#include "objects/common/branches.h"
#include "objects/lsystem/plant.h"

#include <math.h>
#include <stdio.h>

static bool own_space(OwnSpace *own, void *params, Error *e)
{
    (void)e;
    LSystemPlantParams *plant = params;
    own_space_stand(own, plant->position, vec3(0, 0, 0));
    plant->position = vec3(0, 0, 0);
    return true;
}

static void describe(const void *params, char *text, size_t size)
{
    const LSystemPlantParams *plant = params;
    snprintf(text, size, ", %g m, %d generations", (double)plant->height, plant->generations);
}

static int64_t copies(const void *params)
{
    const LSystemPlantParams *plant = params;
    return plant->leaves.max_count;
}

// A plant is drawn in milliseconds; what takes memory is its skin. A string that cannot be drawn
// adds nothing: growth reports the error.
static void needs(const void *params, Needs *needs)
{
    enum { LEAF_FACES = 25, LEAVES = 50000, NODE_BYTES = 700 };
    const LSystemPlantParams *plant = params;
    Run run = run_default();
    Recipe recipe = {.run = &run};
    Grown grown = {0};
    Error e = {0};
    if (lsystem_plant_grow(params, &recipe, &grown, &e) &&
        lsystem_plant_finish(params, &recipe, &grown, &grown, &e)) {
        SkinParams skin = branches_skin(&plant->skin);
        needs_add(needs, "generations", (double)grown.tree->count, NODE_BYTES);
        needs_add_skin(needs, "generations", skin_estimate(grown.tree, &skin));
    }
    grown_clear(&grown);
    needs_add_copies(needs, "leaves.max_count", fmin((double)copies(params), LEAVES), LEAF_FACES);
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0),
    TWIG_MATERIAL_ROW(1),
    LEAF_MATERIAL_ROW(2),
    {0},
};

const Kind kind_lsystem = {
    .variant = {KIND_ROW("lsystem", &lsystem_table, "A plant described by an L-system."),
                MATERIALS},
    .carried = true,
    .materials = {"bark", "twig", "leaf"},
    .own_space = own_space,
    .needs = needs,
    .describe = describe,
    .copies = copies,
    .grow = lsystem_plant_grow,
    .finish = lsystem_plant_finish,
    .geometry = lsystem_plant_geometry};
