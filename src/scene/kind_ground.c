// The ground as a kind of object.
#include "scene/kinds.h"
#include "scene/scene_flood.h"

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    (void)tree;
    GroundMaterials materials = {.ground = placing_material(p, p->object->material, "ground"),
                                 .grass = placing_material(p, p->object->grass_material, "grass"),
                                 .fallen = placing_material(p, p->object->leaf_material, "fallen"),
                                 .bark = placing_material(p, NULL, "bark"),
                                 .foliage = placing_material(p, NULL, "leaf")};
    SceneFlood water;
    if (!scene_flood_init(&water, p->scene, p->recipe.run, e)) {
        return false;
    }
    bool done = ground_geometry(p->object->ground, &materials, p->index, p->recipe.seed,
                                &water.flood, &p->world->geometry, p->recipe.run, e);
    scene_flood_clear(&water);
    return done;
}

static int64_t copies(const SceneObject *object)
{
    const GroundParams *ground = object->ground;
    return ground->grass_tufts + ground->fallen_leaves + ground->trees.count;
}

const Kind kind_ground = {.key = "ground",
                          .offset = offsetof(SceneObject, ground),
                          .reads_water = true,
                          .materials = {"material", "leaf_material", "grass_material"},
                          .place = place,
                          .copies = copies};
