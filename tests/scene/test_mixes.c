// Woods of several species: distant ones on the ground, and forests.
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
    Scene *scene =
        fixture_read(*state, MEADOW(RING "count: 8, variants: 2, season: 10.2, species: ["
                                         "{share: 3, tree: {species: beech}, leaf_material: clay}, "
                                         "{tree: {species: scots_pine, height: 4}}]"));
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
        TEST(a_mix_names_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
