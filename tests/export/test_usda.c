// USD files of worlds that no scene makes today: sheared, flattened and mirrored instances, glowing
// curves, read by OpenUSD.
#include "testing.h"

#include "../render/tiny_world.h"
#include "export/formats.h"
#include "render/world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/ramify_usda_XXXXXX";

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static const char *peers(void)
{
    const char *named = getenv("RAMIFY_PEERS");
    return named ? named : "build/peers";
}

// Skips the test where OpenUSD is not installed.
static void need_openusd(void)
{
    char command[512];
    snprintf(command, sizeof command, "'%s/python/bin/python' -c 'import pxr.Usd' 2>/dev/null",
             peers());
    if (system(command) != 0) {
        skip();
    }
}

static bool write_world(const World *world, const char *name, const Run *run, Error *e)
{
    const char *const names[] = {"thing"};
    const ExportSource source = {
        .title = "a \"quoted\" \\ title", .world = world, .object_count = 1, .object_name = names};
    char file[128];
    snprintf(file, sizeof file, "%s/%s", folder, name);
    return usda_format.write(&source, file, run, e);
}

static void expect(const char *name, const char *measures)
{
    char command[1024];
    snprintf(command, sizeof command, "'%s/python/bin/python' tests/peers/usd_check.py %s/%s %s",
             peers(), folder, name, measures);
    assert_int_equal(system(command), 0);
}

// Area and volume of all instances of the sphere, and the box around them.
typedef struct Sums {
    double area, volume;
    Aabb box;
} Sums;

static Sums measure(const Mesh *mesh, const Transform *place, int count)
{
    Sums sums = {.box = aabb_empty()};
    for (int i = 0; i < count; i++) {
        Vec3 z = transform_vector(&place[i], vec3(0, 0, 1));
        Vec3 across = vec3_cross(transform_vector(&place[i], vec3(1, 0, 0)),
                                 transform_vector(&place[i], vec3(0, 1, 0)));
        double side = vec3_dot(across, z) < 0.0f ? -1.0 : 1.0;
        for (int64_t f = 0; f < mesh->face_count; f++) {
            const uint32_t *c = mesh->index + 4 * f;
            const int split[6] = {0, 1, 3, 2, 3, 1};
            for (int t = 0; t < 2; t++) {
                Vec3 p[3];
                for (int k = 0; k < 3; k++) {
                    p[k] = transform_point(&place[i], mesh->position[c[split[3 * t + k]]]);
                    sums.box = aabb_add(sums.box, p[k]);
                }
                Vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
                sums.area += 0.5 * (double)vec3_length(n);
                sums.volume += side * (double)vec3_dot(p[0], vec3_cross(p[1], p[2])) / 6.0;
            }
        }
    }
    return sums;
}

enum { PLACES = 6 };

static const Transform PLACE[PLACES] = {
    {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
    {{{0, -2, 0, 5}, {2, 0, 0, 1}, {0, 0, 3, 0}}},    // turned and stretched
    {{{-1, 0, 0, -4}, {0, 1, 0, 2}, {0, 0, 1, 1}}},   // mirrored
    {{{1, 0.5f, 0, 0}, {0, 1, 0, 6}, {0, 0, 1, 0}}},  // sheared
    {{{-1, 0.5f, 0, 9}, {0, 1, 0, 6}, {0, 0, 1, 0}}}, // sheared and mirrored
    {{{1, 0, 0, 0}, {0, 0, 0, -5}, {0, 0, 1, 0}}},    // flattened
};

static World *world_of_places(int first, int count)
{
    World *world = tiny_world(64, 64, 1, 0.5f);
    Transform *instance = malloc(sizeof PLACE);
    assert_non_null(instance);
    memcpy(instance, PLACE + first, sizeof *instance * (size_t)count);
    add_part(world, (Part){.kind = PART_MESH,
                           .mesh = sphere_mesh(vec3(0.5f, 0, 0), 1.0f, 12, true),
                           .instance = instance,
                           .instance_count = count});
    return world;
}

static void check_places(int first, int count, const char *name)
{
    need_openusd();
    Error e = {0};
    Run run = run_default();
    World *world = world_of_places(first, count);
    assert_true(write_world(world, name, &run, &e));
    Sums sums = measure(world->geometry.part[0].mesh, PLACE + first, count);
    char measures[512];
    snprintf(measures, sizeof measures,
             "instances=%d area=%.9g~1e-3 volume=%.9g~1e-3 low=%.9g,%.9g,%.9g~2e-3 "
             "high=%.9g,%.9g,%.9g~2e-3 triangles=%d",
             count, sums.area, sums.volume, (double)sums.box.low.x, (double)sums.box.low.y,
             (double)sums.box.low.z, (double)sums.box.high.x, (double)sums.box.high.y,
             (double)sums.box.high.z, 2 * 2 * 12 * 12);
    expect(name, measures);
    world_free(world);
}

static void instances_that_can_be_are_in_an_instancer(void **state)
{
    (void)state;
    check_places(0, 3, "plain.usda");
}

// The stored triangles of instances that refer to the prototype are counted once each.
static void sheared_instances_are_not_lost(void **state)
{
    (void)state;
    need_openusd();
    Error e = {0};
    Run run = run_default();
    World *world = world_of_places(0, PLACES);
    assert_true(write_world(world, "sheared.usda", &run, &e));
    Sums sums = measure(world->geometry.part[0].mesh, PLACE, PLACES);
    char measures[512];
    snprintf(measures, sizeof measures,
             "instances=%d area=%.9g~1e-3 volume=%.9g~1e-3 seen_triangles=%d", PLACES, sums.area,
             sums.volume, PLACES * 2 * 2 * 12 * 12);
    expect("sheared.usda", measures);
    world_free(world);
}

static void only_sheared_instances_are_fine(void **state)
{
    (void)state;
    need_openusd();
    Error e = {0};
    Run run = run_default();
    World *world = world_of_places(3, 3);
    assert_true(write_world(world, "only.usda", &run, &e));
    expect("only.usda", "instances=3");
    world_free(world);
}

static void curves_glow_and_lines_are_long(void **state)
{
    (void)state;
    need_openusd();
    Error e = {0};
    Run run = run_default();
    World *world = tiny_world(64, 64, 1, 0.5f);
    world->material[0] = material_default(MATERIAL_EMISSION);
    strcpy(world->material[0].name, "arc");
    CurveSet *curves = curves_new(5, 2, &e);
    assert_non_null(curves);
    curves->glow = malloc(5 * sizeof(float));
    assert_non_null(curves->glow);
    for (int i = 0; i < 5; i++) {
        curves->position[i] = vec3((float)i, i > 2 ? 1.0f : 0.0f, 0);
        curves->radius[i] = 0.125f * (float)(i + 1);
        curves->birth[i] = curves->glow[i] = 0.25f * (float)i;
    }
    const int64_t first[3] = {0, 3, 5};
    memcpy(curves->first, first, sizeof first);
    add_part(world, (Part){.kind = PART_CURVES, .curves = curves});
    assert_true(write_world(world, "arc.usda", &run, &e));
    expect("arc.usda", "segments=3 meshes=0 low=-0.125,-0.375,-0.625 high=4.625,1.625,0.625");
    world_free(world);
}

static void an_empty_world_is_a_stage(void **state)
{
    (void)state;
    need_openusd();
    Error e = {0};
    Run run = run_default();
    World *world = tiny_world(64, 32, 1, 0.5f);
    assert_true(write_world(world, "empty.usda", &run, &e));
    expect("empty.usda", "meshes=0 aspect=2~1e-6");
    world_free(world);
}

// Of young trees: there are curves, but none yet.
static void what_is_empty_is_left_out(void **state)
{
    (void)state;
    need_openusd();
    Error e = {0};
    Run run = run_default();
    World *world = world_of_places(0, 1);
    CurveSet *curves = curves_new(0, 0, &e);
    assert_non_null(curves);
    add_part(world, (Part){.kind = PART_CURVES, .curves = curves});
    assert_true(write_world(world, "young.usda", &run, &e));
    expect("young.usda", "meshes=1 segments=0");
    world_free(world);
}

static void what_is_cancelled_leaves_nothing(void **state)
{
    (void)state;
    volatile int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    Error e = {0};
    World *world = world_of_places(0, 2);
    assert_false(write_world(world, "cancelled.usda", &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    char command[128];
    snprintf(command, sizeof command, "test -z \"$(ls -A %s | grep cancelled)\"", folder);
    assert_int_equal(system(command), 0);
    world_free(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_that_can_be_are_in_an_instancer),
        cmocka_unit_test(sheared_instances_are_not_lost),
        cmocka_unit_test(only_sheared_instances_are_fine),
        cmocka_unit_test(curves_glow_and_lines_are_long),
        cmocka_unit_test(an_empty_world_is_a_stage),
        cmocka_unit_test(what_is_empty_is_left_out),
        cmocka_unit_test(what_is_cancelled_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
