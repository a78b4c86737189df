// Woods of several species: distant ones on the ground, and forests.
#include "objects/forest/individuals.h"
#include "objects/ground/ground.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene_fixture.h"

#define MEADOW(TREES) \
    "objects:\n  - name: meadow\n    ground: {grass_tufts: 0, trees: {" TREES "}}\n"
#define RING "inner: 20, outer: 60, clumping: 0, height: 5, "

static World *build(const Scene *scene)
{
    Error e = {0};
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, &e);
    if (!world) {
        fail_msg("%s", e.message);
    }
    return world;
}

// Instances of the first part with this material; 0 without one.
static int64_t copies_of(const World *world, const char *material)
{
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        if (strcmp(world->material[part->material].name, material) == 0) {
            return part->instance_count;
        }
    }
    return 0;
}

static void distant_woods_are_of_three_species(void **state)
{
    Scene *scene = fixture_read(*state, MEADOW(RING "count: 20, variants: 1"));
    World *world = build(scene);
    assert_true(copies_of(world, "pedunculate_oak_leaf") >= 7);
    assert_true(copies_of(world, "lime_leaf") >= 5);
    assert_true(copies_of(world, "silver_birch_leaf") >= 5);
    assert_int_equal(copies_of(world, "leaf"), 0);
    world_free(world);
    scene_free(scene);
}

static void a_mix_has_shares_materials_and_a_season(void **state)
{
    Scene *scene = fixture_read(
        *state,
        MEADOW(RING
               "count: 8, variants: 2, season: 10.2, species: ["
               "{share: 3, tree: {species: beech, light: {seasons: 10}}, leaf_material: clay}, "
               "{tree: {species: scots_pine, height: 4, light: {seasons: 10}}}]"));
    const GroveParams *woods = &((const GroundParams *)scene->objects[0].params)->trees;
    World *world = build(scene);
    assert_int_equal(woods->species_count, 2);
    assert_true(woods->species[0].tree->leaves.autumn > 0.1f);
    assert_true(woods->species[1].tree->leaves.autumn < 0.1f); // evergreen
    assert_int_equal(copies_of(world, "clay"), 6);
    assert_int_equal(copies_of(world, "scots_pine_bark"), 2);
    world_free(world);
    scene_free(scene);
}

// ---- forests

// The birch's form is its own here, whatever the library's: a forest, not a species, is tested.
#define FOREST(MORE)                                                                             \
    "objects:\n  - name: wood\n    forest: {height: 6, radius: 14, glade: 0, ferns: 0, stands: " \
    "1, "                                                                                        \
    "stand_trees: 4, leaves: {max_count: 300}, species: [{share: 2, tree: {species: beech, "     \
    "light: "                                                                                    \
    "{seasons: 20}}}, {tree: {species: silver_birch, light: {seasons: 20, apical_control: "      \
    "[0.6, 0.545], shade: 0.3, shoot: [6, 6, 6], branch_angle: [38, 45, 50], tropism: [0.06, "   \
    "0.03, -0.22], unevenness: 0}}}]" MORE "}\n"

static void a_forest_is_of_its_species_on_any_threads(void **state)
{
    Scene *scene = fixture_read(*state, FOREST(""));
    World *world = build(scene);
    Error e = {0};
    Run one = run_default(), three = run_default();
    one.threads = 1;
    three.threads = 3;
    OutTree *tree = scene_grow_object(scene, 0, &one, &e);
    OutTree *same = scene_grow_object(scene, 0, &three, &e);
    assert_non_null(tree);
    assert_non_null(same);
    assert_true(out_tree_hash(tree) == out_tree_hash(same));
    assert_true(copies_of(world, "beech_leaf") > 0 && copies_of(world, "silver_birch_bark") > 0);
    assert_int_equal(copies_of(world, "leaf"), 0);
    out_tree_free(tree);
    out_tree_free(same);
    world_free(world);
    scene_free(scene);
}

// Mean place of the branches' nodes of one individual from its foot, in heights of the tree.
static Vec3 middle_of(const Individuals *all, const OutTree *grown, int index)
{
    OutTree *tree = individuals_tree(all, grown, index, NULL);
    Vec3 sum = vec3(0, 0, 0);
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] == TREE_CROWN) {
            sum = vec3_add(sum, tree->position[i]);
            count++;
        }
    }
    float height = out_tree_bounds(tree).high.y;
    out_tree_free(tree);
    return vec3_scale(sum, count > 0 ? 1.0f / ((float)count * height) : 0.0f);
}

// Crowns of inner trees are higher than those in the open, and those of an edge lean outward.
static void trees_are_as_their_situation(void **state)
{
    Scene *scene = fixture_read(*state, FOREST(", spacing: 1.8"));
    const ForestParams *forest = scene->objects[0].params;
    Run run = run_default();
    Recipe recipe = {.seed = 5, .label = "wood", .run = &run};
    Individuals all;
    OutTree *grown = out_tree_new(NULL);
    assert_true(individuals_init(&all, forest, 5, NULL));
    assert_true(individuals_grow(&all, &recipe, grown, NULL));
    Vec3 middle[3] = {{0}};
    int count[3] = {0};
    for (int i = 0; i < all.count; i++) {
        const Individual *one = &all.one[i];
        if (one->kept && one->params.height > 5.9f) {
            Situation of = one->situation;
            middle[of] = vec3_add(middle[of], middle_of(&all, grown, i));
            count[of]++;
        }
    }
    assert_true(count[SITUATION_INNER] > 0 && count[SITUATION_EDGE] > 1);
    assert_int_equal(count[SITUATION_OPEN], 2);
    for (int k = 0; k < 3; k++) {
        middle[k] = vec3_scale(middle[k], 1.0f / (float)count[k]);
    }
    assert_true(middle[SITUATION_INNER].y > 1.05f * middle[SITUATION_OPEN].y);
    assert_true(middle[SITUATION_EDGE].z > middle[SITUATION_INNER].z + 0.02f);
    out_tree_free(grown);
    individuals_free(&all);
    scene_free(scene);
}

static void a_mix_names_what_is_wrong(void **state)
{
    fixture_refuse(*state, MEADOW("species: [{tree: {species: beach}}]"), "beech", 3);
    fixture_refuse(*state, MEADOW("species: [{share: 2}]"), "tree", 3);
    fixture_refuse(*state, MEADOW("species: [{tree: {}, leaf_material: leave}]"),
                   "there is no material 'leave'", 3);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, fixture_set_up, fixture_tear_down)
    const struct CMUnitTest tests[] = {
        TEST(distant_woods_are_of_three_species),
        TEST(a_mix_has_shares_materials_and_a_season),
        TEST(a_forest_is_of_its_species_on_any_threads),
        TEST(trees_are_as_their_situation),
        TEST(a_mix_names_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
