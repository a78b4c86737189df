// Grass, trees and ferns keep out of the water that lies on their ground.
#include "render/world.h"
#include "scene/builder.h"
#include "scene/scene_flood.h"

#include "scene_fixture.h"

#define WOODS                                                                                      \
    "  - name: land\n"                                                                             \
    "    ground: {grass_tufts: 900, grass_radius: 30, flat_radius: 60, trees: {count: 12, inner: " \
    "5, outer: 40, clumping: 0, variants: 1, bare: true, species: [{tree: {species: hazel, "       \
    "height: 4, light: {seasons: 8}}}]}}\n"                                                        \
    "  - name: wood\n"                                                                             \
    "    forest: {height: 6, stand_trees: 3, stands: 1, radius: 30, glade: 0, ferns: 300, "        \
    "fern_radius: 30, leaves: {max_count: 50}}\n"
#define POND "shape: {envelope: [{shape: box, size: [15, 1, 15], position: [15, -0.5, 0]}]}\n"

// Things with instances, and those of them in x 0.5 .. 29.5, z -14.5 .. 14.5: where the pond lies.
typedef struct Plants {
    int all, in_pond;
} Plants;

static Plants count_plants(const World *world)
{
    Plants plants = {0};
    for (int64_t p = 0; p < world->geometry.count; p++) {
        const Part *part = &world->geometry.part[p];
        for (int64_t i = 0; i < part->instance_count; i++) {
            Vec3 foot = transform_point(&part->instance[i], vec3(0, 0, 0));
            plants.all++;
            plants.in_pond += foot.x > 0.5f && foot.x < 29.5f && fabsf(foot.z) < 14.5f;
        }
    }
    return plants;
}

static Plants plants_of(Fixture *fixture, const char *text)
{
    Scene *scene = fixture_read(fixture, text);
    Error e = {0};
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, &e);
    if (!world) {
        fail_msg("%s", e.message);
    }
    Plants plants = count_plants(world);
    world_free(world);
    scene_free(scene);
    return plants;
}

static void nothing_stands_in_a_pond(void **state)
{
    // Water by its built-in name, by its index, and as a sheet that looks up.
    static const char *const ponds[] = {
        "objects:\n" WOODS "  - name: pond\n    material: lake\n    " POND,
        "materials: [{name: water, kind: dielectric, ior: 1.33}]\nobjects:\n  - name: pond\n    "
        "material: water\n    " POND WOODS,
        "objects:\n" WOODS "  - name: pond\n    material: lake\n    mesh: {file: sheet.obj}\n",
    };
    static const char sheet[] = "v 0 0.4 -15\nv 0 0.4 15\nv 30 0.4 15\nv 30 0.4 -15\nf 1 2 3 4\n";
    fixture_write(*state, "sheet.obj", sheet, sizeof sheet - 1);
    Plants dry = plants_of(*state, "objects:\n" WOODS);
    assert_true(dry.in_pond > 150);
    for (size_t i = 0; i < sizeof ponds / sizeof ponds[0]; i++) {
        Plants wet = plants_of(*state, ponds[i]);
        assert_int_equal(wet.in_pond, 0);
        assert_true(wet.all > dry.all / 3);
    }
    // Other bodies are no water, nor is water that hangs in the air over the land.
    Plants stone = plants_of(*state, "objects:\n" WOODS "  - name: slab\n    " POND);
    assert_int_equal(stone.in_pond, dry.in_pond);
    Plants drop = plants_of(*state, "objects:\n" WOODS
                                    "  - name: drop\n    material: lake\n    shape: {envelope: "
                                    "[{shape: sphere, size: 9, position: [12, 20, 0]}]}\n");
    assert_int_equal(drop.in_pond, dry.in_pond);
}

static void nothing_stands_under_the_sea(void **state)
{
    Plants shallow = plants_of(*state, "medium: {kind: water, height: -100}\nobjects:\n" WOODS);
    Plants deep = plants_of(*state, "medium: {kind: water, height: 100}\nobjects:\n" WOODS);
    assert_true(shallow.all > 300);
    assert_int_equal(deep.all, 0);
}

// Woods are made again when their water changes, and only then.
static void a_pond_that_dries_up_frees_the_land(void **state)
{
    Scene *scene =
        fixture_read(*state, "objects:\n" WOODS "  - name: pond\n    material: lake\n    " POND
                             "  - name: stone\n    shape: {envelope: [{shape: sphere, "
                             "size: 1, position: [-50, 0, 0]}]}\n");
    Error e = {0};
    Run run = run_default();
    BuildStats stats = {0};
    SceneBuilder *builder = scene_builder_new(false, &e);
    const World *world = scene_builder_build(builder, scene, &run, &stats, &e);
    assert_non_null(world);
    const Mesh *land = world->geometry.part[0].mesh;
    assert_int_equal(count_plants(world).in_pond, 0);
    SceneChange stone = {"objects.stone.shape.voxel", "0.1", "a test", 0, 0};
    Scene *moved = scene_changed(scene, &stone, 1, &e);
    assert_true(moved && scene_flood_hash(moved) == scene_flood_hash(scene));
    world = scene_builder_build(builder, moved, &run, &stats, &e);
    assert_true(world->geometry.part[0].mesh == land);
    SceneChange dry = {"objects.pond.material", "clay", "a test", 0, 0};
    Scene *later = scene_changed(scene, &dry, 1, &e);
    assert_true(later && scene_flood_hash(later) == 0);
    world = scene_builder_build(builder, later, &run, &stats, &e);
    assert_true(world && count_plants(world).in_pond > 150);
    scene_builder_free(builder);
    scene_free(scene);
    scene_free(moved);
    scene_free(later);
}

// The place of the land's sample that is nearest.
static int64_t nearest_sample(const HeightField *land, Vec3 p)
{
    int64_t column = (int64_t)((p.x - land->origin.x) / land->cell.x + 0.5f);
    int64_t row = (int64_t)((p.z - land->origin.y) / land->cell.y + 0.5f);
    return row * land->columns + column;
}

// Nor on the surface of the lakes and rivers of a terrain.
static void nothing_stands_on_a_lake(void **state)
{
    static const char text[] =
        "objects:\n  - name: hills\n    terrain: {resolution: 64, size: 6000, form: alps, lakes: "
        "{count: 9, silt: 0.2}}\n  - name: stones\n    scatter: {on: hills, count: 2000, "
        "radius: 0, variants: 1, things: [{stone: {size: 4}}]}\n";
    Scene *scene = fixture_read(*state, text);
    Error e = {0};
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, &e);
    assert_non_null(world);
    const HeightField *land = NULL;
    int64_t stones = 0, wet = 0;
    for (int64_t p = 0; p < world->geometry.count; p++) {
        const Part *part = &world->geometry.part[p];
        land = part->land ? part->land : land;
        for (int64_t i = 0; part->object == 1 && i < part->instance_count; i++) {
            Vec3 foot = transform_point(&part->instance[i], vec3(0, 0, 0));
            assert_true(land && foot.y > land->water[nearest_sample(land, foot)] - 4.0f);
            wet += foot.y < land->water[nearest_sample(land, foot)] + 0.5f;
            stones++;
        }
    }

    assert_in_range(stones, 1500, 2000);
    assert_in_range(wet, 0, 8); // at shores; with those on the lakes 35
    world_free(world);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(nothing_stands_in_a_pond, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(nothing_stands_on_a_lake, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(nothing_stands_under_the_sea, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(a_pond_that_dries_up_frees_the_land, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
