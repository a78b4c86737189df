// Plants written as L-systems as a kind of object.
#include "objects/lsystem/plant.h"
#include "scene/kinds.h"

#include <math.h>
#include <stdio.h>

static bool own_space(OwnSpace *own, Error *e)
{
    LSystemPlantParams *plant = own_space_copy(own, own->object.lsystem, sizeof *plant, e);
    if (plant) {
        own->object.lsystem = plant;
        own_space_stand(own, plant->position, vec3(0, 0, 0));
        plant->position = vec3(0, 0, 0);
    }
    return plant;
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return lsystem_plant_grow(object->lsystem, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    TreeMaterials materials = {.bark = placing_material(p, p->object->material, "bark"),
                               .twig = placing_material(p, p->object->twig_material, "twig"),
                               .leaf = placing_material(p, p->object->leaf_material, "leaf")};
    return lsystem_plant_geometry(tree, p->object->lsystem, &materials, p->index, p->recipe.seed,
                                  &p->world->geometry, p->recipe.run, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %g m, %d generations", (double)object->lsystem->height,
             object->lsystem->generations);
}

static int64_t copies(const SceneObject *object)
{
    return object->lsystem->leaves.max_count;
}

static void needs(const SceneObject *object, Needs *needs)
{
    // of a large plant; three branches a fork are typical
    enum { LEAF_FACES = 25, LEAVES = 50000, GENERATIONS = 6, BRANCH_BYTES = 69000 };
    const LSystemPlantParams *plant = object->lsystem;
    double branches = pow(3.0, fmin(plant->generations, GENERATIONS));
    needs_add(needs, "generations", branches, BRANCH_BYTES * exp2(2.0 * plant->skin.levels));
    needs_add_copies(needs, "leaves.max_count", fmin((double)copies(object), LEAVES), LEAF_FACES);
}

const Kind kind_lsystem = {.key = "lsystem",
                           .offset = offsetof(SceneObject, lsystem),
                           .materials = {"material", "twig_material", "leaf_material"},
                           .own_space = own_space,
                           .grow = grow,
                           .needs = needs,
                           .place = place,
                           .describe = describe,
                           .copies = copies};
