// A tree as a kind of object.
#include "objects/tree/defaults.h"
#include "scene/kinds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// It stands on its trunk and has no turn.
static bool own_space(OwnSpace *own, Error *e)
{
    TreeParams *tree = own_space_copy(own, own->object.tree, sizeof *tree, e);
    if (!tree) {
        return false;
    }
    own->object.tree = tree;
    own_space_stand(own, tree->position, vec3(0, 0, 0));
    tree->position = vec3(0, 0, 0);
    return own_space_take_element(own, &tree->trunk.element, e) &&
           own_space_take_element(own, &tree->crown.element, e) &&
           own_space_take_element(own, &tree->roots.element, e);
}

static OutTree *grow(const SceneObject *object, const Recipe *recipe, Error *e)
{
    return tree_grow(object->tree, recipe, e);
}

static bool place(const Placing *p, const OutTree *tree, Error *e)
{
    TreeMaterials materials = {.bark = placing_material(p, p->object->material, "bark"),
                               .twig = placing_material(p, p->object->twig_material, "twig"),
                               .leaf = placing_material(p, p->object->leaf_material, "leaf")};
    return tree_geometry(tree, p->object->tree, &materials, p->index, p->recipe.seed,
                         &p->world->geometry, p->recipe.run, e);
}

static void describe(const SceneObject *object, char *text, size_t size)
{
    snprintf(text, size, ", %g m", (double)object->tree->height);
}

static void settle(const SceneObject *object, void *params)
{
    TreePlan plan;
    tree_plan_make(&plan, object->tree, 0); // no seed changes a number of the file's keys
    memcpy(params, &plan.params, sizeof plan.params);
}

typedef struct TreeAttractors {
    int64_t trunk, crown, roots;
} TreeAttractors;

// Those of the model's own levels too.
static TreeAttractors count_attractors(const SceneObject *object)
{
    TreePlan plan;
    tree_plan_make(&plan, object->tree, 0); // no seed changes how many
    const TreeParams *p = &plan.params;
    return (TreeAttractors){element_attractors(&p->trunk.element),
                            element_attractors(&p->crown.element),
                            p->roots.count > 0 ? element_attractors(&p->roots.element) : 0};
}

static int64_t attractors(const SceneObject *object)
{
    TreeAttractors count = count_attractors(object);
    return count.trunk + count.crown + count.roots;
}

static int64_t copies(const SceneObject *object)
{
    return object->tree->leaves.max_count;
}

// Nature's ranges: radii after Eloy (2011); the others are usual for broad-leaved trees.
static bool measure(const SceneObject *object, const OutTree *tree, const Recipe *recipe,
                    MeasureList *list, Error *e)
{
    (void)recipe;
    (void)object;
    (void)tree;
    (void)e;
    measures_set_range(list, "radius_exponent", 1.8, 2.3);
    measures_set_range(list, "branch_angle", 30.0, 70.0);
    measures_set_range(list, "horton_number", 3.0, 5.0);
    measures_set_range(list, "tip_radius", 0.0005, 0.002);
    return true;
}

static void needs(const SceneObject *object, Needs *needs)
{
    enum { LEAF_FACES = 25, LEAVES_AN_ATTRACTOR = 6 };
    TreeAttractors each = count_attractors(object);
    double count = (double)attractors(object), leaves = (double)object->tree->leaves.max_count;
    int levels = object->tree->skin.levels;
    double twig = (double)(object->tree->skin.curve_radius / object->tree->radii.tip);
    needs_add_skinned_growth(needs, "trunk.growth.levels", (double)each.trunk, levels, twig);
    needs_add_skinned_growth(needs, "crown.growth.levels", (double)each.crown, levels, twig);
    needs_add_skinned_growth(needs, "roots.growth.levels", (double)each.roots, levels, twig);
    needs_add_copies(needs, "leaves.max_count", fmin(leaves, LEAVES_AN_ATTRACTOR * count),
                     LEAF_FACES);
}

const Kind kind_tree = {.key = "tree",
                        .offset = offsetof(SceneObject, tree),
                        .materials = {"material", "twig_material", "leaf_material"},
                        .own_space = own_space,
                        .grow = grow,
                        .needs = needs,
                        .place = place,
                        .measure = measure,
                        .describe = describe,
                        .settle = settle,
                        .attractors = attractors,
                        .copies = copies};
