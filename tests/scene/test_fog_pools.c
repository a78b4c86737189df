// Clouds over objects: the floor of fog is that of the land that has grown, also after changes;
// spray is that of the falls.
#include "scene_fixture.h"

#include "land/cold_pool.h"
#include "render/lamp_field.h"
#include "render/world.h"
#include "scene/builder.h"
#include "scene/needs.h"

#define LAND                                                                                 \
    "objects: [{name: land, terrain: {form: noise, size: 500, relief: 120, resolution: 64, " \
    "position: [300, 40, -200], noise: {iterations: 5}}}]\n"
#define FOG "clouds: [{kind: fog, over: land, thickness: 30, size: 60, pool: 80}]\n"
#define WIDE \
    "clouds: [{kind: stratus}, {kind: fog, over: land, thickness: 30, size: 60, pool: 160}]\n"

static const HeightField *land_of(const World *world)
{
    for (int64_t i = 0; i < world->geometry.count; i++) {
        if (world->geometry.part[i].land) {
            return world->geometry.part[i].land;
        }
    }
    fail_msg("no land is kept");
    return NULL;
}

// The floor of a cloud is the level of the land in the scene.
static void assert_floor(const World *world, int cloud, float radius)
{
    Run run = run_default();
    ColdPoolParams params = {.radius = radius, .depth = 30.0f};
    HeightField *level = cold_pool_level(land_of(world), &params, &run, NULL);
    assert_non_null(level);
    const CloudFloor *floor = world->cloud[cloud].floor;
    assert_non_null(floor);
    assert_int_equal(floor->side, level->columns);
    assert_true(floor->x == 50.0f && floor->z == -450.0f && floor->cell == level->cell.x);
    float low, high;
    height_field_range(level, &low, &high);
    assert_true(floor->least == low && floor->most == high && low < high);
    assert_memory_equal(floor->height, level->height,
                        sizeof *level->height * (size_t)height_field_count(level));
    height_field_free(level);
}

static void fog_lies_on_the_land_that_has_grown(void **state)
{
    Run run = run_default();
    Error e = {0};
    Scene *first = fixture_read(*state, FOG LAND), *second = fixture_read(*state, WIDE LAND);
    BuildStats stats = {0};
    SceneBuilder *builder = scene_builder_new(true, &e);
    assert_non_null(builder);
    World *world = scene_builder_build(builder, first, &run, &stats, &e);
    assert_non_null(world);
    assert_floor(world, 0, 80.0f);
    assert_true(scene_builder_fits(builder, second)); // nothing grows anew
    world = scene_builder_build(builder, second, &run, &stats, &e);
    assert_non_null(world);
    assert_null(world->cloud[0].floor);
    assert_floor(world, 1, 160.0f);
    scene_builder_free(builder);
    scene_free(first);
    scene_free(second);
}

// A terrain that shows its map has no land.
static void fog_needs_land(void **state)
{
    Run run = run_default();
    Error e = {0};
    Scene *scene = fixture_read(*state, FOG "objects: [{name: land, terrain: {form: noise, "
                                            "resolution: 64, show: map}}]\n");
    assert_null(scene_build(scene, &run, NULL, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "object 'land' is no terrain that shows its land"));
    scene_free(scene);
}

static void spray_needs_falls(void **state)
{
    Run run = run_default();
    Error e = {0};
    Scene *scene = fixture_read(*state, "clouds: [{kind: spray, over: land}]\n" LAND);
    assert_null(scene_build(scene, &run, NULL, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "object 'land' throws up no spray"));
    scene_free(scene);
    scene = fixture_read(*state, "clouds: [{kind: spray, of: water, over: land}]\n" LAND);
    assert_null(scene_build(scene, &run, NULL, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "object 'land' has no falling water"));
    assert_string_equal(e.key, "clouds.0.over");
    scene_free(scene);
}

// The cloud gathers what the parts of its object carry; of falling water each fall has a cloud.
static void spray_is_that_of_the_falls(void **state)
{
    Run run = run_default();
    Error e = {0};
    Scene *scene = fixture_read(
        *state, "seed: 5\n"
                "clouds: [{kind: spray, of: water, over: land}, {kind: spray, over: land}]\n"
                "objects: [{name: land, terrain: {size: 600, relief: 170, resolution: 512, "
                "rivers: {count: 14, outlets: 1, side: south, gradient: 0.75, water: 0.01, "
                "runoff: 16}, terraces: {count: 6, strength: 0.95, sheer: 1}, "
                "noise: {wavelength: 0.06, amplitude: 0.12}}}]\n");
    World *world = scene_build(scene, &run, NULL, &e);
    assert_non_null(world);
    int64_t parcels = 0, falls = 0;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const SprayParcels *spray = world->geometry.part[i].spray;
        parcels += spray ? spray->count : 0;
        falls += world->geometry.part[i].water != NULL;
    }
    assert_true(parcels > 0);
    assert_int_equal(world->cloud[1].spray->count, parcels);
    assert_true(falls > 1);
    assert_int_equal(world->cloud_count, 1 + falls);
    for (int i = 0; i < world->cloud_count; i++) {
        assert_true(i == 1 ||
                    (world->cloud[i].of == SPRAY_WATER && world->cloud[i].spray->count > 0));
    }
    world_free(world);
    scene_free(scene);
}

// The fog's grid is as wide as the terrain and its mirror image: higher land, a higher grid.
static void estimates_know_the_terrain(void **state)
{
    Scene *low = fixture_read(*state, FOG LAND);
    Scene *high = fixture_read(*state, FOG "objects: [{name: land, terrain: {form: noise, size: "
                                           "500, relief: 360, resolution: 64}}]\n");
    double more = scene_memory(high) - scene_memory(low);
    double nodes = 512.0 * 512.0 * 240.0 / (1000.0 / 512.0); // for the relief that is added
    assert_true(more > 4.0 * nodes && more < 20.0 * nodes);
    scene_free(low);
    scene_free(high);
}

// The light of lamps in clouds takes memory where there are lamps, lightning among them, and
// clouds.
static void estimates_know_the_lamp_field(void **state)
{
    static const struct {
        const char *text;
        bool made;
    } cases[] = {
        {"clouds: [{kind: cumulus}]\nlights: [{kind: sphere, radiance: 9}]\nobjects: [{name: a, "
         "ground: {}}]\n",
         true},
        {"clouds: [{kind: cumulus}]\nobjects: [{name: a, lightning: {}}]\n", true},
        {"clouds: [{kind: cumulus}]\nobjects: [{name: a, ground: {}}]\n", false},
        {"objects: [{name: a, lightning: {}}]\n", false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char without[256];
        snprintf(without, sizeof without, "render: {lamp_field: false}\n%s", cases[i].text);
        Scene *with = fixture_read(*state, cases[i].text), *none = fixture_read(*state, without);
        double more = scene_memory(with) - scene_memory(none);
        assert_true(cases[i].made ? more == (double)lamp_field_bytes() : more == 0.0);
        scene_free(with);
        scene_free(none);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(fog_lies_on_the_land_that_has_grown, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(fog_needs_land, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(spray_needs_falls, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(spray_is_that_of_the_falls, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(estimates_know_the_terrain, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(estimates_know_the_lamp_field, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
