// Climbers on a wall: a box, whose distance is known in closed form.
#include "render/world.h"
#include "scene/build.h"
#include "scene_fixture.h"

#include <math.h>
#include <stdio.h>

#define WALL                                                                            \
    "objects:\n  - name: wall\n    shape: {voxel: 0.02, envelope: [{shape: box, size: " \
    "[1.5, 1.2, 0.2], position: [0, 1.2, 0]}]}\n"
#define IVY(MORE)                                                                                 \
    "  - name: ivy\n    climber: {climbs: wall, starts: [{position: [-0.5, 0, 0.3]}, {position: " \
    "[0.6, 0, 0.3]}], height: 1.6, spread: 0.8, spacing: 0.1" MORE "}\n"

// Distance to the wall, negative inside.
static float to_wall(Vec3 p)
{
    Vec3 d = vec3(fabsf(p.x) - 1.5f, fabsf(p.y - 1.2f) - 1.2f, fabsf(p.z) - 0.2f);
    Vec3 out = vec3(fmaxf(d.x, 0.0f), fmaxf(d.y, 0.0f), fmaxf(d.z, 0.0f));
    return vec3_length(out) + fminf(fmaxf(d.x, fmaxf(d.y, d.z)), 0.0f);
}

static OutTree *grow(const Scene *scene, int threads)
{
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    OutTree *tree = scene_grow_object(scene, scene_find_object(scene, "ivy"), &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

// Stems lie on the wall by their radius and the gap, within a voxel of its level set.
static void test_stems_cling(void **state)
{
    Scene *scene = fixture_read(*state, WALL IVY(", offset: 0.01, hanging: {count: 0}"));
    OutTree *tree = grow(scene, 2);
    float highest = 0.0f, widest = 0.0f;
    assert_true(tree->count > 200);
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        float gap = to_wall(p) - tree->radius[i];
        if (fabsf(p.z) > 0.2f && fabsf(p.x) < 1.45f && p.y < 2.35f) { // not about its edges
            assert_true(gap > 0.002f && gap < 0.018f);
        }
        assert_true(gap > -0.03f);
        highest = fmaxf(highest, p.y);
        widest = fmaxf(widest, fabsf(p.x));
    }
    assert_true(highest > 1.1f && highest < 2.4f);
    assert_true(widest > 1.0f);
    out_tree_free(tree);
    scene_free(scene);
}

// Hanging shoots leave the wall, none enters it, and nothing else changes.
static void test_shoots_hang_free(void **state)
{
    Scene *bare = fixture_read(*state, WALL IVY(", hanging: {count: 0}"));
    Scene *scene =
        fixture_read(*state, WALL IVY(", hanging: {count: 40, length: 0.6, droop: 0.8}"));
    OutTree *clinging = grow(bare, 2), *tree = grow(scene, 2);
    assert_true(tree->count > clinging->count + 100);
    float farthest = 0.0f, fall = 0.0f;
    for (int64_t i = clinging->count; i < tree->count; i++) {
        float off = to_wall(tree->position[i]);
        assert_true(off > 0.0f);
        farthest = fmaxf(farthest, off);
        fall += tree->position[i].y - tree->position[tree->parent[i]].y;
    }
    assert_memory_equal(tree->parent, clinging->parent,
                        (size_t)clinging->count * sizeof *tree->parent);
    assert_true(farthest > 0.1f && farthest < 0.6f);
    assert_true(fall < 0.0f);
    out_tree_free(tree);
    out_tree_free(clinging);
    scene_free(scene);
    scene_free(bare);
}

// Length (m) of the hanging shoots in each of `count` squares of the wall's front, of side 0.25 m.
static void shoots_in_squares(const OutTree *tree, int64_t clinging, float *length, int count)
{
    for (int64_t i = clinging; i < tree->count; i++) {
        int64_t foot = i;
        while (foot >= clinging) {
            foot = tree->parent[foot];
        }
        Vec3 p = tree->position[foot];
        int square = 8 * (int)(p.y / 0.25f) + (int)((p.x + 1.0f) / 0.25f);
        if (p.z > 0.19f && fabsf(p.x) < 1.0f && square >= 0 && square < count) {
            length[square] += vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
        }
    }
}

// In masses, shoots fill some squares of the wall and leave others; spread evenly they do not.
static void test_shoots_gather_in_masses(void **state)
{
    enum { SQUARES = 48 };
    static const char *const HANGING[] = {"0", "1, clump_size: 0.7"};
    double unevenness[2] = {0};
    Scene *bare = fixture_read(*state, WALL IVY(", hanging: {count: 0}"));
    OutTree *clinging = grow(bare, 2);
    for (int k = 0; k < 2; k++) {
        char text[2000];
        snprintf(text, sizeof text, WALL IVY(", hanging: {count: 900, length: 0.2, clumping: %s}"),
                 HANGING[k]);
        Scene *scene = fixture_read(*state, text);
        OutTree *tree = grow(scene, 2);
        float length[SQUARES] = {0};
        shoots_in_squares(tree, clinging->count, length, SQUARES);
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < SQUARES; i++) {
            sum += (double)length[i];
            squares += (double)(length[i] * length[i]);
        }
        unevenness[k] = SQUARES * squares / (sum * sum);
        out_tree_free(tree);
        scene_free(scene);
    }
    assert_true(unevenness[1] > 1.3 * unevenness[0]);
    out_tree_free(clinging);
    scene_free(bare);
}

// The upper sides of the leaves look away from the wall.
static void test_leaves_face_outward(void **state)
{
    Scene *scene = fixture_read(*state, WALL IVY(", hanging: {count: 0}"));
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, NULL);
    assert_non_null(world);
    int64_t leaves = 0, outward = 0, inside = 0;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        for (int64_t k = 0; k < part->instance_count; k++) {
            Vec3 foot = transform_point(&part->instance[k], vec3(0, 0, 0));
            Vec3 upper = transform_vector(&part->instance[k], vec3(0, 0, 1));
            if (foot.z > 0.2f && fabsf(foot.x) < 1.4f && foot.y < 2.3f) {
                leaves++;
                outward += upper.z > 0.0f;
            }
            inside += to_wall(foot) < -0.005f;
        }
    }
    assert_true(leaves > 500);
    assert_true((double)outward > 0.95 * (double)leaves);
    assert_true((double)inside < 0.02 * (double)leaves);
    world_free(world);
    scene_free(scene);
}

// Rootlets of a growth on the wall: curves all as thin as these.
static const CurveSet *find_rootlets(const World *world, float radius)
{
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const CurveSet *curves = world->geometry.part[i].curves;
        if (curves && curves->radius[0] == radius) {
            return curves;
        }
    }
    return NULL;
}

// Distance from p to the nearest stem of the tree, less its radius.
static float to_stems(const OutTree *tree, Vec3 p)
{
    float least = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->parent[i] >= 0) {
            Vec3 a = tree->position[tree->parent[i]], b = tree->position[i];
            Vec3 way = vec3_sub(b, a);
            float t = vec3_dot(vec3_sub(p, a), way) / fmaxf(vec3_dot(way, way), 1e-12f);
            Vec3 at = vec3_madd(a, clampf(t, 0.0f, 1.0f), way);
            least = fminf(least, vec3_distance(p, at) - tree->radius[i]);
        }
    }
    return least;
}

#define ROOTLETS ", rootlets: {spacing: 0.004, length: 0.02, radius: 0.00037}"

// Rootlets start on the stems and end nearer to the wall, outside of it; shoots that hang have
// none; without the key there are none.
static void test_rootlets_hold_stems(void **state)
{
    const float radius = 0.00037f;
    Scene *scene = fixture_read(*state, WALL IVY(ROOTLETS ", hanging: {count: 0}"));
    Scene *hanging = fixture_read(*state, WALL IVY(ROOTLETS ", hanging: {count: 60}"));
    Scene *bare = fixture_read(*state, WALL IVY(", hanging: {count: 0}"));
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, NULL);
    World *other = scene_build(hanging, &run, NULL, NULL);
    World *none = scene_build(bare, &run, NULL, NULL);
    OutTree *tree = grow(scene, 2);
    const CurveSet *curves = find_rootlets(world, radius), *same = find_rootlets(other, radius);
    assert_non_null(curves);
    assert_non_null(same);
    assert_null(find_rootlets(none, radius));
    assert_true(curves->curve_count > 300);
    // thicker stems bear more, and a pipe's radii grow by what hangs on it: by less than a half
    assert_true(same->curve_count < 3 * curves->curve_count / 2);
    int64_t nearer = 0, inside = 0, step = curves->curve_count / 150;
    int64_t looked = 0;
    for (int64_t i = 0; i < curves->curve_count; i += step, looked++) {
        Vec3 foot = curves->position[curves->first[i]];
        Vec3 tip = curves->position[curves->first[i + 1] - 1];
        assert_true(to_stems(tree, foot) < 0.002f);
        nearer += to_wall(tip) < to_wall(foot);
        inside += to_wall(tip) < -0.01f; // a voxel of the wall's level set is 0.02 m
    }
    assert_true((double)nearer > 0.6 * (double)looked);
    assert_true((double)inside < 0.03 * (double)looked);
    out_tree_free(tree);
    world_free(world);
    world_free(other);
    world_free(none);
    scene_free(scene);
    scene_free(hanging);
    scene_free(bare);
}

#define RACEMES                                                                                 \
    ", hanging: {count: 0}, leaves: {max_count: 0}, organs: [{kind: blossom, cluster: raceme, " \
    "hang: 1, stalk: 0.02, season: [4.8, 5.8]}]"

static int64_t count_instances(const World *world)
{
    int64_t count = 0;
    for (int64_t i = 0; i < world->geometry.count; i++) {
        count += world->geometry.part[i].instance_count;
    }
    return count;
}

// Racemes hang before the wall, in their season alone.
static void test_organs_hang_before_the_wall(void **state)
{
    Scene *scene = fixture_read(*state, WALL IVY(RACEMES ", season: 5.2"));
    Scene *summer = fixture_read(*state, WALL IVY(RACEMES ", season: 7"));
    Run run = run_default();
    World *world = scene_build(scene, &run, NULL, NULL), *none;
    none = scene_build(summer, &run, NULL, NULL);
    assert_non_null(world);
    assert_non_null(none);
    assert_int_equal(count_instances(none), 0);
    assert_true(count_instances(world) > 100);
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        for (int64_t k = 0; k < part->instance_count; k++) {
            Vec3 foot = transform_point(&part->instance[k], vec3(0, 0, 0));
            Vec3 along = vec3_normalize(transform_vector(&part->instance[k], vec3(0, 1, 0)));
            bool about_edge =
                foot.z < 0.2f || fabsf(foot.x) > 1.4f || foot.y > 2.3f || foot.y < 0.1f;
            assert_true(to_wall(foot) > (about_edge ? -0.02f : 0.01f));
            assert_true(along.y < -0.9f);
        }
    }
    world_free(world);
    world_free(none);
    scene_free(scene);
    scene_free(summer);
}

static void test_same_bits_for_any_thread_count(void **state)
{
    Scene *scene = fixture_read(*state, WALL IVY(""));
    OutTree *one = grow(scene, 1);
    for (int threads = 2; threads <= 3; threads++) {
        OutTree *other = grow(scene, threads);
        assert_true(out_tree_hash(one) == out_tree_hash(other));
        out_tree_free(other);
    }
    out_tree_free(one);
    scene_free(scene);
}

static void test_refusals(void **state)
{
    fixture_refuse(*state,
                   WALL "  - name: ivy\n    climber: {climbs: well, starts: [{position: [0, "
                        "0, 0]}]}\n",
                   "objects.ivy.climber.climbs: there is no object 'well'; did you mean 'wall'", 5);
    fixture_refuse(*state,
                   WALL "  - name: ivy\n    climber: {climbs: ivy, starts: [{position: [0, "
                        "0, 0]}]}\n",
                   "objects.ivy.climber.climbs leads back to 'ivy' itself", 5);
    fixture_refuse(*state, WALL "  - name: ivy\n    climber: {climbs: wall}\n", "starts", 5);
    fixture_refuse(*state, WALL IVY(", season: 0.5"), "months begin at 1", 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_stems_cling, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_shoots_hang_free, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_shoots_gather_in_masses, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_leaves_face_outward, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_rootlets_hold_stems, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_organs_hang_before_the_wall, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_same_bits_for_any_thread_count, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(test_refusals, fixture_set_up, fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
