#include "objects/lsystem/plant.h"

#include "base/random.h"
#include "grow/lsystem/turtle.h"
#include "outtree/radii.h"

#include <stddef.h>

enum { STREAM_STRING = 1, STREAM_TURTLE = 2 }; // of the object's seed

// Monopodial and sympodial forks by divergence angles, bent by gravity (The Algorithmic Beauty of
// Plants, figure 2.8): the trunk forks in three, branches fork again.
static const char TREE_AXIOM[] = "!(1)F(1.2)/(45)A";
static const char TREE_RULES[] =
    "d1 = 94.74; d2 = 132.63; a = 18.95; l = 1.109; w = 1.732\n"
    "A -> !(w)F(0.5)[&(a)F(0.5)A]/(d1)[&(a)F(0.5)A]/(d2)[&(a)F(0.5)A]\n"
    "F(x) -> F(x*l)\n"
    "!(x) -> !(x*w)";

LSystemPlantParams lsystem_plant_params_default(void)
{
    TreeParams tree = tree_params_default();
    tree.radii.tip = 0.0024f;
    tree.leaves.twig_radius = 0.011f;
    return (LSystemPlantParams){.height = 12.0f,
                                .generations = 7,
                                .angle = 30.0f,
                                .step = 1.0f,
                                .tropism = {0, -1, 0},
                                .elasticity = 0.14f,
                                .radii = tree.radii,
                                .leaves = tree.leaves,
                                .skin = tree.skin};
}

static bool sets_widths(const OutTree *tree)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->radius[i] <= 0.0f) {
            return false;
        }
    }
    return true;
}

// Scales to the given height and moves the first root to the position.
static void scale_to(OutTree *tree, float height, Vec3 position)
{
    float top = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        float y = tree->position[i].y - tree->position[0].y;
        top = y > top ? y : top;
    }
    float scale = height > 0.0f && top > 0.0f ? height / top : 1.0f;
    Vec3 foot = tree->position[0];
    for (int64_t i = 0; i < tree->count; i++) {
        tree->position[i] = vec3_madd(position, scale, vec3_sub(tree->position[i], foot));
    }
}

// Widths are in the string's own unit: scales the widest to the root's radius.
static void scale_widths(OutTree *tree, float radius)
{
    float widest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        widest = tree->radius[i] > widest ? tree->radius[i] : widest;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        tree->radius[i] *= radius / widest;
    }
}

static OutTree *draw(const LSystemPlantParams *p, const Recipe *recipe, Error *e)
{
    LSystemParams system = {.axiom = p->axiom ? p->axiom : TREE_AXIOM,
                            .rules = p->rules ? p->rules : (p->axiom ? "" : TREE_RULES),
                            .generations = p->generations,
                            .seed = random_key(recipe->seed, STREAM_STRING)};
    ModuleString string;
    if (!lsystem_derive(&system, recipe->run, &string, e)) {
        return NULL;
    }
    TurtleParams turtle = turtle_params_default();
    turtle.step = p->step;
    turtle.angle = p->angle;
    turtle.tropism = p->tropism;
    turtle.elasticity = p->elasticity;
    turtle.noise = p->noise;
    turtle.seed = random_key(recipe->seed, STREAM_TURTLE);
    OutTree *tree = turtle_draw(&string, &turtle, recipe->run, e);
    module_string_clear(&string);
    return tree;
}

bool lsystem_plant_grow(const void *given, const Recipe *recipe, Grown *whole, Error *e)
{
    const LSystemPlantParams *params = given;
    whole->tree = draw(params, recipe, e);
    if (whole->tree) {
        scale_to(whole->tree, params->height, params->position);
    }
    return whole->tree;
}

bool lsystem_plant_finish(const void *given, const Recipe *recipe, const Grown *whole, Grown *grown,
                          Error *e)
{
    (void)recipe, (void)whole, (void)e;
    const LSystemPlantParams *p = given;
    Aabb box = out_tree_bounds(grown->tree);
    float radius = p->radius > 0.0f ? p->radius : 0.02f * (box.high.y - box.low.y);
    if (sets_widths(grown->tree)) {
        scale_widths(grown->tree, radius);
    } else {
        out_tree_pipe_radii(grown->tree, p->radii.exponent, p->radii.tip, p->radius);
    }
    return true;
}

bool lsystem_plant_geometry(const void *given, const Grown *grown, const Placing *placing, Error *e)
{
    const LSystemPlantParams *params = given;
    TreeParams as_tree = tree_params_default();
    Aabb box = out_tree_bounds(grown->tree);
    as_tree.position = params->position;
    as_tree.roots.count = 0;
    as_tree.grown_by = GROWN_BY_ATTRACTORS;
    as_tree.height = box.high.y - box.low.y;
    as_tree.leaves = params->leaves;
    as_tree.skin = params->skin;
    return tree_geometry(&as_tree, grown, placing, e);
}
