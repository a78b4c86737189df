// Frost flowers: the angles, planes and lengths of their sides, what stays above the ice, the
// blades.
#include "testing.h"

#include "base/random.h"
#include "objects/frost_flower/frost_flower.h"

#include <stdlib.h>

static Grown grow(const FrostFlowerParams *params, uint64_t seed)
{
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = seed, .label = "object 'flower'", .run = &run};
    Grown grown = {0};
    if (!frost_flower_grow(params, &recipe, &grown, &e) || !out_tree_check(grown.tree, &e) ||
        !frost_flower_finish(params, &recipe, &grown, &grown, &e)) {
        fail_msg("%s", e.message);
    }
    return grown;
}

// Number of the node among its parent's children, by its id; -1 for none of the first three.
static int place_of(const OutTree *tree, int64_t i)
{
    for (int place = 0; place < 3; place++) {
        if (tree->id[i] == out_tree_child_id(tree->id[tree->parent[i]], place)) {
            return place;
        }
    }
    return -1;
}

static bool is_side(const OutTree *tree, int64_t i)
{
    return tree->parent[i] >= 0 && tree->parent[tree->parent[i]] >= 0 && place_of(tree, i) > 0;
}

static Vec3 step_to(const OutTree *tree, int64_t i)
{
    return vec3_sub(tree->position[i], tree->position[tree->parent[i]]);
}

// Of each node: 0 on a rib. The caller frees them.
static int32_t *orders_of(const OutTree *tree)
{
    int32_t *order = calloc(1 + (size_t)tree->count, sizeof *order);
    assert_non_null(order);
    for (int64_t i = 0; i < tree->count; i++) {
        order[i] = tree->parent[i] < 0 ? 0 : order[tree->parent[i]] + (place_of(tree, i) > 0);
    }
    return order;
}

// Without a fold along the rib, which only barbs have, a side leaves at its angle in the plane.
static void sides_leave_at_the_angle_of_ice(void **state)
{
    (void)state;
    for (int angle = 45; angle <= 60; angle += 15) {
        FrostFlowerParams params = frost_flower_params_default();
        params.angle = (float)angle;
        Grown grown = grow(&params, 3);
        const OutTree *tree = grown.tree;
        double sum = 0.0, most = 0.0;
        int64_t count = 0;
        for (int64_t i = 0; i < tree->count; i++) {
            if (is_side(tree, i)) {
                Vec3 a = vec3_normalize(step_to(tree, i)),
                     b = vec3_normalize(step_to(tree, tree->parent[i]));
                double turn = acos((double)clampf(vec3_dot(a, b), -1, 1)) * 180.0 / M_PI;
                sum += turn;
                most = fabs(turn - angle) > most ? fabs(turn - angle) : most;
                count++;
            }
        }
        print_message("angle %d: mean %.2f over %lld sides, %.1f off at most\n", angle,
                      sum / (double)count, (long long)count, most);
        assert_true(fabs(sum / (double)count - angle) < 0.3);
        assert_true(most < 10.0); // 5 standard deviations
        grown_clear(&grown);
    }
}

// Normals are unit and across the way; both sides of a node are in their plane, to left and right.
static void sides_lie_in_the_plane_of_their_feather(void **state)
{
    (void)state;
    FrostFlowerParams params = frost_flower_params_default();
    params.uneven = 1.0f; // with twisted feathers, too
    Grown grown = grow(&params, 4);
    const OutTree *tree = grown.tree;
    int64_t left = 0, right = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(fabsf(vec3_length(tree->normal[i]) - 1.0f) < 1e-4f);
        if (tree->parent[i] < 0) {
            continue;
        }
        Vec3 way = vec3_normalize(step_to(tree, i));
        assert_true(fabsf(vec3_dot(way, tree->normal[i])) < 1e-3f);
        if (is_side(tree, i)) {
            Vec3 before = step_to(tree, tree->parent[i]), normal = tree->normal[tree->parent[i]];
            float turned = vec3_dot(vec3_cross(before, way), normal);
            assert_true(place_of(tree, i) == 1 ? turned > 0.0f : turned < 0.0f);
            left += place_of(tree, i) == 1;
            right += place_of(tree, i) == 2;
        }
    }
    assert_true(left > 1000 && llabs(left - right) < left / 10);
    grown_clear(&grown);
}

// Spacing of barbs and their number follow from the keys; orders are as many as asked for.
static void barbs_and_orders_are_as_many_as_asked_for(void **state)
{
    (void)state;
    for (int orders = 1; orders <= 3; orders++) {
        FrostFlowerParams params = frost_flower_params_default();
        params.feathers = 8;
        params.barbs = 20;
        params.skip = 0.0f;
        params.orders = orders;
        Grown grown = grow(&params, 5);
        int32_t *order = orders_of(grown.tree), highest = 0;
        float spacing = 0.5f * params.size / (float)params.barbs;
        int64_t ribs = 0;
        for (int64_t i = 0; i < grown.tree->count; i++) {
            highest = order[i] > highest ? order[i] : highest;
            if (order[i] == 0 && grown.tree->parent[i] >= 0) {
                assert_true(fabsf(vec3_length(step_to(grown.tree, i)) / spacing - 1.0f) < 0.1f);
                ribs++;
            }
        }
        assert_int_equal(highest, orders);
        assert_true(ribs > 8 * 20 / 2 && ribs <= 8 * 21);
        free(order);
        grown_clear(&grown);
    }
}

// Barbules of one barb must not reach the next: sides of sides are shorter than the way to it.
static void sides_end_before_their_neighbours(void **state)
{
    (void)state;
    FrostFlowerParams params = frost_flower_params_default();
    params.orders = 3;
    params.feathers = 10;
    Grown grown = grow(&params, 6);
    const OutTree *tree = grown.tree;
    int32_t *order = orders_of(tree);
    assert_true(tree->count > 0);
    float *length = calloc(1 + (size_t)tree->count, sizeof *length); // m, since its branch left
    float spacing = 0.5f * params.size / (float)params.barbs, longest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        if (order[i] == 2) {
            bool first = order[tree->parent[i]] < 2;
            length[i] = (first ? 0.0f : length[tree->parent[i]]) + vec3_length(step_to(tree, i));
            longest = length[i] > longest ? length[i] : longest;
        }
    }
    print_message("longest barbule %.2f of the distance of barbs\n", (double)(longest / spacing));
    assert_true(longest < 0.92f * spacing && longest > 0.5f * spacing);
    free(order);
    free(length);
    grown_clear(&grown);
}

static void it_stands_on_the_ice_and_has_its_size(void **state)
{
    (void)state;
    double widths = 0.0;
    enum { SEEDS = 8 };
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        FrostFlowerParams params = frost_flower_params_default();
        params.size = 0.5f;
        Grown grown = grow(&params, seed);
        Aabb box = out_tree_bounds(grown.tree);
        assert_true(box.low.y == 0.0f);
        assert_true(box.high.y > 0.1f && box.high.y < 0.7f);
        double width = (double)(box.high.x - box.low.x + box.high.z - box.low.z) / 2.0;
        assert_true(width > 0.3 && width < 0.65);
        widths += width / SEEDS;
        grown_clear(&grown);
    }
    print_message("of 0.5 m, mean %.3f m wide\n", widths);
    assert_true(fabs(widths - 0.5) < 0.1);
}

// A scaled flower is the same one, scaled; another seed makes another one.
static void size_scales_and_seeds_differ(void **state)
{
    (void)state;
    FrostFlowerParams params = frost_flower_params_default();
    Grown one = grow(&params, 7), other = grow(&params, 8);
    params.size *= 4.0f;
    Grown large = grow(&params, 7);
    assert_int_equal(one.tree->count, large.tree->count);
    for (int64_t i = 0; i < one.tree->count; i++) {
        Vec3 p = vec3_scale(one.tree->position[i], 4.0f);
        assert_true(vec3_distance(p, large.tree->position[i]) < 1e-5f);
        assert_int_equal(one.tree->birth[i], large.tree->birth[i]);
    }
    assert_true(out_tree_hash(one.tree) != out_tree_hash(other.tree));
    grown_clear(&one);
    grown_clear(&other);
    grown_clear(&large);
}

// Of the tips of the feathers seen from above: how far their mean is from the foot, in their mean
// distance, and the widest gap between two neighbours of the outer half, degrees.
static void spread_of(const OutTree *tree, double *off, double *gap)
{
    enum { MOST = 64 };
    double azimuth[MOST], x = 0.0, z = 0.0, reach = 0.0;
    Vec3 tip[MOST] = {0};
    int feathers = 0, outer = 0;
    int32_t *order = orders_of(tree);
    for (int64_t i = 0; i < tree->count; i++) {
        if (order[i] == 0) { // a rib's last node comes last
            tip[tree->colony[i]] = tree->position[i];
            feathers = tree->colony[i] + 1 > feathers ? tree->colony[i] + 1 : feathers;
        }
    }
    free(order);
    for (int i = 0; i < feathers; i++) {
        x += (double)tip[i].x / feathers;
        z += (double)tip[i].z / feathers;
        reach += hypot((double)tip[i].x, (double)tip[i].z) / feathers;
        if (i < feathers / 2) { // upright: of no clear azimuth
            continue;
        }
        double a = atan2((double)tip[i].z, (double)tip[i].x) * 180.0 / M_PI;
        int at = outer++;
        for (; at > 0 && azimuth[at - 1] > a; at--) {
            azimuth[at] = azimuth[at - 1];
        }
        azimuth[at] = a;
    }
    *off = hypot(x, z) / reach;
    *gap = azimuth[0] + 360.0 - azimuth[outer - 1];
    for (int i = 1; i < outer; i++) {
        *gap = azimuth[i] - azimuth[i - 1] > *gap ? azimuth[i] - azimuth[i - 1] : *gap;
    }
}

static void uneven_flowers_lean_and_have_gaps(void **state)
{
    (void)state;
    double off[2] = {0}, gap[2] = {0};
    enum { SEEDS = 12 };
    for (int uneven = 0; uneven < 2; uneven++) {
        for (uint64_t seed = 1; seed <= SEEDS; seed++) {
            FrostFlowerParams params = frost_flower_params_default();
            params.orders = 1;
            params.uneven = (float)uneven;
            Grown grown = grow(&params, seed);
            double o, g;
            spread_of(grown.tree, &o, &g);
            off[uneven] += o / SEEDS;
            gap[uneven] += g / SEEDS;
            grown_clear(&grown);
        }
    }
    print_message("mean tip off the foot %.2f, uneven %.2f; widest gap %.0f, uneven %.0f degrees\n",
                  off[0], off[1], gap[0], gap[1]);
    assert_true(off[0] < 0.12 && off[1] > 2.0 * off[0]);
    assert_true(gap[0] < 60.0 && gap[1] > 1.2 * gap[0]);
}

static void blades_are_closed_and_shared_out(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        FrostFlowerParams params = frost_flower_params_default();
        params.feathers = 6;
        params.rime = (float)k;
        Grown grown = grow(&params, 9);
        Error e = {0};
        Run run = run_default();
        Recipe recipe = {.seed = 9, .label = "object 'flower'", .run = &run};
        Geometry geometry = {0};
        const int material[2] = {10, 11};
        Placing placing = {.recipe = &recipe, .geometry = &geometry, .material = material};
        assert_true(frost_flower_geometry(&params, &grown, &placing, &e));
        int64_t faces[2] = {0};
        for (int p = 0; p < (int)geometry.count; p++) {
            const Mesh *mesh = geometry.part[p].mesh;
            MeshTopology topology;
            assert_true(mesh_topology(mesh, &topology, &e));
            assert_int_equal(topology.open_edges, 0);
            assert_int_equal(topology.overused_edges, 0);
            assert_int_equal(topology.misoriented_edges, 0);
            faces[geometry.part[p].material - 10] += mesh->face_count;
        }
        assert_true(faces[k] > 0 && faces[1 - k] == 0);
        geometry_clear(&geometry);
        grown_clear(&grown);
    }
}

static void a_cancelled_growth_stops(void **state)
{
    (void)state;
    int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    FrostFlowerParams params = frost_flower_params_default();
    Recipe recipe = {.seed = 1, .label = "object 'flower'", .run = &run};
    Grown grown = {0};
    Error e = {0};
    assert_false(frost_flower_grow(&params, &recipe, &grown, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    grown_clear(&grown);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sides_leave_at_the_angle_of_ice),
        cmocka_unit_test(sides_lie_in_the_plane_of_their_feather),
        cmocka_unit_test(barbs_and_orders_are_as_many_as_asked_for),
        cmocka_unit_test(sides_end_before_their_neighbours),
        cmocka_unit_test(it_stands_on_the_ice_and_has_its_size),
        cmocka_unit_test(size_scales_and_seeds_differ),
        cmocka_unit_test(uneven_flowers_lean_and_have_gaps),
        cmocka_unit_test(blades_are_closed_and_shared_out),
        cmocka_unit_test(a_cancelled_growth_stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
