// Clouds as OpenVDB grids: read back, they are the clouds that were written.
#include "scene_fixture.h"

#include "base/random.h"
#include "render/cloud/clouds.h"
#include "render/world.h"
#include "scene/export_grids.h"

#define FOG                                                                                     \
    "clouds: [{kind: fog, over: land, thickness: 6, size: 60, pool: 80, cover: 1, resolution: " \
    "128}]\n"
#define LAND                                                                               \
    "objects: [{name: land, terrain: {form: noise, size: 500, relief: 4, resolution: 64, " \
    "position: [300, 40, -200], noise: {iterations: 5}}}]\n"

static CloudSet *clouds_of(const Cloud *cloud, int count, uint64_t seed)
{
    Run run = run_default();
    Error e = {0};
    CloudSet *clouds = clouds_new(cloud, count, seed, &run, &e);
    if (!clouds) {
        fail_msg("%s", e.message);
    }
    return clouds;
}

// Compares the scene's first cloud with the file's where the file has samples.
static void assert_read_back(const CloudSet *grown, const char *file)
{
    Cloud cloud = cloud_default(CLOUD_GRID);
    cloud.grid = "clouds/0/density";
    cloud.file = file;
    cloud.extinction = 1.0f;
    CloudSet *read = clouds_of(&cloud, 1, 1);
    Aabb box;
    float distance;
    clouds_samples_of(grown, 0, &box, &distance);
    Vec3 size = vec3_scale(vec3_sub(box.high, box.low), 1.0f / distance);
    int dense = 0;
    for (uint64_t i = 0; i < 20000; i++) {
        Vec3 at = vec3(floorf(size.x * random_unit(random_key(i, 0))),
                       floorf(size.y * random_unit(random_key(i, 1))),
                       floorf(size.z * random_unit(random_key(i, 2))));
        Vec3 p = vec3_madd(box.low, distance, at);
        float wanted = clouds_extinction_of(grown, 0, p);
        assert_float_equal(clouds_extinction(read, p), wanted, 5e-4f); // where a place is rounded
        dense += wanted > 0.0f;
    }
    assert_true(dense > 200);
    clouds_free(read);
}

// The samples are those of one period: the land and its mirror image.
static void assert_period(const CloudSet *grown, const CloudFloor *floor)
{
    Aabb box;
    float distance;
    clouds_samples_of(grown, 0, &box, &distance);
    float period = 2.0f * floor->cell * (float)(floor->side - 1);
    assert_float_equal(box.high.x - box.low.x + distance, period, 0.01f * distance);
    assert_float_equal(box.high.z - box.low.z + distance, period, 0.01f * distance);
    assert_float_equal(box.low.x, floor->x, 0.01f * distance);
}

static void fog_is_read_back_as_it_was_written(void **state)
{
    Fixture *fixture = *state;
    Run run = run_default();
    Error e = {0};
    Scene *scene = fixture_read(fixture, FOG LAND);
    GridFile *grids = scene_grids(scene, &run, &e);
    if (!grids) {
        fail_msg("%s", e.message);
    }
    assert_int_equal(grid_file_count(grids), 1);
    char file[128];
    snprintf(file, sizeof file, "%s/clouds.vdb", fixture->folder);
    assert_true(grid_file_write(grids, file, &e));
    World *world = scene_build(scene, &run, NULL, &e);
    assert_non_null(world);
    CloudSet *grown = clouds_of(world->cloud, world->cloud_count, world->cloud_seed);
    assert_period(grown, world->cloud->floor);
    assert_read_back(grown, file);
    clouds_free(grown);
    grid_file_free(grids);
    world_free(world);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(fog_is_read_back_as_it_was_written, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
