// Plants written as L-systems as a kind of object.
#include "objects/kind.h"
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

static void needs(const void *params, Needs *needs)
{
    // of a large plant; three branches per fork are typical
    enum { LEAF_FACES = 25, LEAVES = 50000, GENERATIONS = 6, BRANCH_BYTES = 69000 };
    const LSystemPlantParams *plant = params;
    double branches = pow(3.0, fmin(plant->generations, GENERATIONS));
    needs_add(needs, "generations", branches, BRANCH_BYTES * exp2(2.0 * plant->skin.levels));
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
    .materials = {"bark", "twig", "leaf"},
    .own_space = own_space,
    .needs = needs,
    .describe = describe,
    .copies = copies,
    .grow = lsystem_plant_grow,
    .finish = lsystem_plant_finish,
    .geometry = lsystem_plant_geometry};
