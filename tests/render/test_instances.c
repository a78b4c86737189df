// Parts of an object with the same instances are instanced together: every ray still finds the
// right part and instance, and three parts take about as much memory as one.
#include "base/random.h"
#include "render/accel/accel.h"
#include "tiny_world.h"

#include <malloc.h>

enum { COLUMNS = 200, ROWS = 100, COUNT = COLUMNS * ROWS };
enum { BALL, CURVES, CAP, PARTS }; // of a tree, in this order
#define SPACING 4.0f               // m

// The tree of a place: turned about the vertical and scaled.
static Transform place_of(int i)
{
    float size = random_range(random_key(3, (uint64_t)i), 0.7f, 1.2f);
    float turn = random_range(random_key(4, (uint64_t)i), 0.0f, 360.0f);
    Vec3 at = vec3(SPACING * (float)(i % COLUMNS), 0.0f, SPACING * (float)(i / COLUMNS));
    return transform_compose(at, vec3(0, turn, 0), vec3_splat(size));
}

static Transform *places(void)
{
    Transform *place = memory_alloc(COUNT, sizeof *place, NULL);
    assert_non_null(place);
    for (int i = 0; i < COUNT; i++) {
        place[i] = place_of(i);
    }
    return place;
}

// A vertical rod beside the ball.
static CurveSet *rod(void)
{
    CurveSet *curves = curves_new(2, 1, NULL);
    assert_non_null(curves);
    curves->position[0] = vec3(0.6f, -0.5f, 0.0f);
    curves->position[1] = vec3(0.6f, 1.5f, 0.0f);
    curves->radius[0] = curves->radius[1] = 0.1f;
    curves->first[0] = 0;
    curves->first[1] = 2;
    return curves;
}

// parts: of each tree, from the first. A small mesh that the ray tracer copies out, drawn once,
// stands among the parts, so that their numbers do not follow each other.
static World *forest(int parts)
{
    World *world = tiny_world(8, 8, 1, 0.5f);
    for (int i = 0; i < parts; i++) {
        Part part = {.instance = places(), .instance_count = COUNT};
        if (i == CURVES) {
            part.kind = PART_CURVES;
            part.curves = rod();
        } else {
            part.mesh = sphere_mesh(vec3(0, i == CAP ? 1.2f : 0.0f, 0), i == CAP ? 0.2f : 0.4f, 16,
                                    i == CAP);
        }
        add_part(world, part);
        if (i == CURVES) {
            add_mesh(world, quad_mesh(vec3(-9, 0, -9), vec3(1, 0, 0), vec3(0, 0, 1)), 0, 0);
        }
    }
    return world;
}

static Accel *accel_of(const World *world, MaterialSet **materials)
{
    Run run = run_default();
    Error e = {0};
    *materials = material_set_new(world->material, NULL, world->material_count, &run, &e);
    assert_non_null(*materials);
    Accel *accel = accel_new(world, *materials, NULL, &run, &e);
    if (!accel) {
        fail_msg("%s", e.message);
    }
    return accel;
}

// Shoots down or sideways at a part of one tree, where nothing else is in the way.
static Ray ray_at(const Transform *place, int part)
{
    Vec3 aim = transform_point(place, part == BALL     ? vec3(0, 0, 0)
                                      : part == CURVES ? vec3(0.6f, 0.7f, 0.0f)
                                                       : vec3(0, 1.2f, 0));
    Vec3 from = part == BALL ? vec3(0, -3, 0) : part == CURVES ? vec3(0, 0, 1) : vec3(0, 2, 0);
    return (Ray){.origin = vec3_add(aim, from),
                 .direction = vec3_normalize(vec3_neg(from)),
                 .far = 10.0f,
                 .part = -1};
}

static void rays_find_part_and_instance(void **state)
{
    (void)state;
    static const int number[PARTS] = {0, 1, 3}; // the quad is part 2
    World *world = forest(PARTS);
    MaterialSet *materials;
    Accel *accel = accel_of(world, &materials);
    for (int i = 0; i < COUNT; i += 97) {
        Transform place = place_of(i);
        Ray ray[PARTS];
        Hit hit[PARTS], packet_hit[PARTS];
        bool met[PARTS];
        for (int k = 0; k < PARTS; k++) {
            ray[k] = ray_at(&place, k);
        }
        accel_intersect_many(accel, ray, PARTS, packet_hit, met);
        for (int k = 0; k < PARTS; k++) {
            assert_true(accel_intersect(accel, &ray[k], &hit[k]));
            assert_true(met[k]);
            SurfacePlace alone = accel_place(accel, &hit[k]),
                         together = accel_place(accel, &packet_hit[k]);
            assert_int_equal(alone.part, number[k]);
            assert_int_equal(alone.instance, i);
            assert_int_equal(together.part, number[k]);
            assert_int_equal(together.instance, i);
            SurfacePoint point;
            accel_surface(accel, &ray[k], &hit[k], &point);
            assert_int_equal(point.part, number[k]);
            assert_float_equal(vec3_distance(point.position, ray[k].origin), hit[k].t, 1e-4f);
            assert_true(vec3_dot(point.normal, ray[k].direction) < 0.0f);
        }
    }
    Ray down = {.origin = vec3(-8.5f, 1, -8.5f), .direction = vec3(0, -1, 0), .far = 9, .part = -1};
    Hit hit;
    assert_true(accel_intersect(accel, &down, &hit));
    assert_int_equal(accel_place(accel, &hit).part, 2);
    accel_free(accel);
    material_set_free(materials);
    world_free(world);
}

#ifndef __SANITIZE_ADDRESS__ // its heap is not counted
// Bytes of the ray tracer for a forest of such trees: Embree's own count misses the instances
// themselves, which it takes from the heap.
static double bytes_of(int parts)
{
    World *world = forest(parts);
    MaterialSet *materials;
    struct mallinfo2 before = mallinfo2();
    Accel *accel = accel_of(world, &materials);
    struct mallinfo2 after = mallinfo2();
    double bytes =
        (double)(after.uordblks + after.hblkhd) - (double)(before.uordblks + before.hblkhd);
    accel_free(accel);
    material_set_free(materials);
    world_free(world);
    return bytes;
}

static void parts_share_an_instance(void **state)
{
    (void)state;
    double one = bytes_of(1), all = bytes_of(PARTS);
    print_message("bytes per instance: %.0f of one part, %.0f of %d parts\n", one / COUNT,
                  all / COUNT, PARTS);
    assert_true(one > 0.0);
    assert_true(one < 450.0 * COUNT);
    assert_true(all < 1.2 * one);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_find_part_and_instance),
#ifndef __SANITIZE_ADDRESS__
        cmocka_unit_test(parts_share_an_instance),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
