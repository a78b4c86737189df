// Things scattered over land that is drawn of tiles: in the square and in its copies they stand on
// the mesh, out of the water.
#include "mesh/cover.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene_fixture.h"

#define LAND                                                                                       \
    "camera: {position: [200, 150, 300], target: [0, 0, 0]}\n"                                     \
    "objects:\n"                                                                                   \
    "  - name: land\n"                                                                             \
    "    terrain: {form: noise, size: 2000, resolution: 64, beyond: 1, mesh_error: 0.004, lakes: " \
    "{count: 40}, tiles: {count: 8, cells: 32, drawn: true}}\n"
#define STONES(KEYS)                                            \
    "  - name: stones\n"                                        \
    "    scatter: {on: land, count: 400, radius: 0, clumping: " \
    "0, things: [{stone: {size: 1}}], " KEYS "}\n"

static World *build(Fixture *fixture, const char *text, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Scene *scene = fixture_read(fixture, text);
    World *world = scene_build(scene, &run, NULL, &e);
    if (!world) {
        fail_msg("%s", e.message);
    }
    scene_free(scene);
    return world;
}

// The triangles of the land, or of its water.
static Cover *cover_of(const World *world, bool water)
{
    Error e = {0};
    Cover *cover = cover_new(&e);
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        if (part->object == 0 && part->is_water == water && part->mesh && !part->instance) {
            assert_true(cover_add(cover, part->mesh, &e));
        }
    }
    assert_true(cover_finish(cover, &e));
    return cover;
}

typedef struct Stones {
    int64_t own, beyond, wet;
} Stones;

static Stones look_at_stones(const World *world)
{
    Cover *land = cover_of(world, false), *water = cover_of(world, true);
    Stones stones = {0};
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        for (int64_t k = 0; part->object == 1 && k < part->instance_count; k++) {
            Vec3 foot = transform_point(&part->instance[k], vec3(0, 0, 0)), normal;
            float ground, level;
            assert_true(cover_top(land, foot.x, foot.z, &ground, &normal));
            assert_true(fabsf(foot.y - ground) < 0.02f && normal.y > 0.0f);
            stones.wet += cover_top(water, foot.x, foot.z, &level, &normal) && level > foot.y;
            bool own = fabsf(foot.x) <= 1000.0f && fabsf(foot.z) <= 1000.0f;
            stones.own += own;
            stones.beyond += !own;
        }
    }
    cover_free(land);
    cover_free(water);
    return stones;
}

static void stands_on_tiles_beyond_the_square(void **state)
{
    World *world = build(*state, LAND STONES("beyond: 1"), 2);
    Stones stones = look_at_stones(world);
    print_message("%d in the square, %d beyond, %d under water\n", (int)stones.own,
                  (int)stones.beyond, (int)stones.wet);
    assert_int_equal(stones.own, 400);
    assert_true(stones.beyond > 8 * 380 && stones.beyond <= 8 * 400); // the rest at shores
    assert_int_equal(stones.wet, 0);
    world_free(world);
}

// Over the whole mesh, a ninth of the places is the square's, and lakes of copies are water, too.
static void keeps_out_of_the_water_of_copies(void **state)
{
    World *world = build(*state, LAND STONES(""), 2);
    Stones stones = look_at_stones(world);
    print_message("%d in the square, %d beyond, %d under water\n", (int)stones.own,
                  (int)stones.beyond, (int)stones.wet);
    assert_int_equal(stones.own + stones.beyond, 400);
    assert_true(stones.own > 10 && stones.own < 100);
    assert_int_equal(stones.wet, 0);
    world_free(world);
}

static void stands_in_the_water_of_copies(void **state)
{
    World *world = build(*state, LAND STONES("beyond: 1, in_water: true"), 2);
    Stones stones = look_at_stones(world);
    print_message("%d in the square, %d beyond, %d under water\n", (int)stones.own,
                  (int)stones.beyond, (int)stones.wet);
    assert_int_equal(stones.wet, stones.own + stones.beyond);
    assert_true(stones.own == 400 && stones.beyond > 8 * 350);
    world_free(world);
}

static void threads_change_no_place(void **state)
{
    World *one = build(*state, LAND STONES("beyond: 1, align: 1, spacing: 2"), 1);
    World *three = build(*state, LAND STONES("beyond: 1, align: 1, spacing: 2"), 3);
    assert_int_equal(one->geometry.count, three->geometry.count);
    for (int64_t i = 0; i < one->geometry.count; i++) {
        const Part *a = &one->geometry.part[i], *b = &three->geometry.part[i];
        assert_int_equal(a->instance_count, b->instance_count);
        if (a->instance_count > 0) {
            assert_memory_equal(a->instance, b->instance,
                                sizeof *a->instance * (size_t)a->instance_count);
        }
    }
    world_free(one);
    world_free(three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(stands_on_tiles_beyond_the_square, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(keeps_out_of_the_water_of_copies, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(stands_in_the_water_of_copies, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(threads_change_no_place, fixture_set_up, fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
