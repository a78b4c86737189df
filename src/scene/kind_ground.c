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

static void needs(const SceneObject *object, Needs *needs)
{
    enum { TUFT_FACES = 88, LEAF_FACES = 25, TREE_BYTES = 15000000, PARTS = 3 };
    const GroundParams *ground = object->ground;
    needs_add(needs, "grass_tufts", (double)ground->grass_tufts, // half of them find no place
              0.5 * (sizeof(Transform) + sizeof(float)));
    needs_add_copies(needs, "grass_tufts", 0.55 * (double)ground->grass_tufts, TUFT_FACES);
    needs_add_copies(needs, "fallen_leaves", (double)ground->fallen_leaves, LEAF_FACES);
    if (ground->trees.count > 0) {
        needs_add(needs, "trees.variants", ground->trees.variants, TREE_BYTES);
        needs_add_copies(needs, "trees.count", PARTS * (double)ground->trees.count, 1e9);
    }
}

const Kind kind_ground = {.key = "ground",
                          .offset = offsetof(SceneObject, ground),
                          .reads_water = true,
                          .materials = {"material", "leaf_material", "grass_material"},
                          .needs = needs,
                          .place = place,
                          .copies = copies};
