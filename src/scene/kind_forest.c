// A forest as a kind of object. It stands on the scene's ground, if there is one.
#include "objects/forest/forest.h"
#include "objects/forest/stand_places.h"
#include "scene/kinds.h"
#include "scene/scene_flood.h"
#include "scene/spec.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static OutTree *grow(const void *params, const Recipe *recipe, Error *e)
{
    return forest_grow(params, recipe, e);
}

// The first ground of the scene; kind NULL = level land at height 0.
typedef struct Land {
    const Kind *kind;
    const void *params;
    uint64_t seed;
} Land;

static float land_height(const void *user, float x, float z)
{
    const Land *land = user;
    return land->kind ? land->kind->ground(land->params, land->seed, x, z) : 0.0f;
}

static Land find_land(const Scene *scene)
{
    scene = scene->whole ? scene->whole : scene;
    for (int i = 0; i < scene->object_count; i++) {
        const SceneObject *object = &scene->objects[i];
        if (object->kind->ground) {
            return (Land){object->kind, object->params, scene_object_seed(scene, i)};
        }
    }
    return (Land){0};
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    ForestMaterials materials = {.bark = placing_material(p, 0),
                                 .twig = placing_material(p, 1),
                                 .leaf = placing_material(p, 2),
                                 .fern = placing_material(p, 3)};
    Land land = find_land(p->scene);
    SceneFlood water;
    if (!scene_flood_init(&water, p->scene, p->recipe.run, e)) {
        return false;
    }
    bool done =
        forest_geometry(tree, p->object->params, &materials, p->index, p->recipe.seed, land_height,
                        &land, &water.flood, &p->world->geometry, p->recipe.run, e);
    scene_flood_clear(&water);
    return done;
}

static bool measure(const void *params, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    double gap;
    measures_set_range(list, "radius_exponent", 1.8, 2.3);
    measures_set_range(list, "branch_angle", 30.0, 70.0);
    measures_set_range(list, "horton_number", 3.0, 5.0);
    return forest_crown_gap(tree, params, &gap, e) &&
           measures_add(list, "crown_gap", gap, "m", (double)NAN, (double)NAN, e);
}

static void describe(const void *params, char *text, size_t size)
{
    const ForestParams *forest = params;
    snprintf(text, size, ", %g m, %d stands of %d trees", (double)forest->height, forest->stands,
             forest->stand_trees);
}

static int64_t copies(const void *params)
{
    const ForestParams *forest = params;
    return forest->ferns + forest->leaves.max_count * forest->stands;
}

static void needs(const void *params, Needs *needs)
{
    enum { OWN_ATTRACTORS = 2320, LEAVES_AN_ATTRACTOR = 6, LEAF_BYTES = 2500, PARTS = 4 };
    const ForestParams *forest = params;
    double pitch = 1.86 * (double)forest_stand_radius(forest), radius = (double)forest->radius;
    double each = forest->element.level_count > 0 ? (double)element_attractors(&forest->element)
                                                  : (double)OWN_ATTRACTORS * forest->stand_trees;
    double leaves = fmin((double)forest->leaves.max_count, LEAVES_AN_ATTRACTOR * each);
    needs_add_skinned_growth(needs, "stand_trees", each * forest->stands, forest->skin.levels,
                             (double)(forest->skin.curve_radius / forest->radii.tip));
    needs_add(needs, "leaves.max_count", leaves * forest->stands, LEAF_BYTES);
    double places =
        3.628 * radius * radius / (pitch * pitch) * (double)forest->density; // 2 pi / sqrt 3
    needs_add_copies(needs, "radius", PARTS * places, 1e9);
    needs_add_copies(needs, "ferns", 0.5 * (double)forest->ferns, 1e9);
}

static void settle(const void *params, void *settled)
{
    ForestParams p = forest_params_resolve(params);
    memcpy(settled, &p, sizeof p);
}

static const Key MATERIALS[] = {
    OWN_MATERIAL_ROW(0), TWIG_MATERIAL_ROW(1), LEAF_MATERIAL_ROW(2), GRASS_MATERIAL_ROW(3), {0},
};

const Kind kind_forest = {
    .variant = {KIND_ROW("forest", &forest_table, "Stands of trees over the land, with ferns."),
                MATERIALS},
    .reads_scene = true,
    .reads_water = true,
    .materials = {"bark", "twig", "leaf", "grass"},
    .grow = grow,
    .needs = needs,
    .place = place,
    .measure = measure,
    .describe = describe,
    .copies = copies,
    .settle = settle};
