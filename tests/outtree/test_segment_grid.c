// Nearness of segments against brute force.
#include "base/random.h"
#include "outtree/segment_grid.h"
#include "testing.h"

#include <math.h>

static Vec3 place(uint64_t key)
{
    return vec3(random_unit(random_key(key, 1)), random_unit(random_key(key, 2)),
                random_unit(random_key(key, 3)));
}

// Segments of many lengths and radii.
static OutTree *make_tree(int64_t nodes)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    for (int64_t i = 0; i < nodes; i++) {
        uint64_t key = random_key(11, (uint64_t)i);
        int64_t parent = i == 0 ? -1 : (int64_t)(random_unit(random_key(key, 4)) * (float)i);
        Vec3 p = place(key);
        if (parent >= 0 && i % 5) {
            p = vec3_lerp(tree->position[parent], p, 0.05f);
        }
        assert_int_equal(out_tree_add_node(tree, p, parent, 0, 0, key, NULL), i);
        float u = random_unit(random_key(key, 5));
        tree->radius[i] = 0.0005f + 0.03f * u * u * u * u;
    }
    return tree;
}

static double sampled_distance(Vec3 a0, Vec3 a1, Vec3 b0, Vec3 b1)
{
    double least = INFINITY;
    for (int i = 0; i <= 100; i++) {
        for (int k = 0; k <= 100; k++) {
            Vec3 p = vec3_lerp(a0, a1, (float)i / 100), q = vec3_lerp(b0, b1, (float)k / 100);
            least = fmin(least, (double)vec3_distance(p, q));
        }
    }
    return least;
}

static void distances_of_segments_are_the_least(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 60; i++) {
        Vec3 p[4];
        for (uint64_t k = 0; k < 4; k++) {
            p[k] = place(random_key(i, k));
        }
        p[1] = i % 7 == 0 ? p[0] : p[1]; // points
        p[3] = i % 11 == 0 ? p[2] : p[3];
        if (i % 5 == 0) { // parallel
            p[3] = vec3_add(p[2], vec3_sub(p[1], p[0]));
        }
        double found = (double)segment_distance(p[0], p[1], p[2], p[3]);
        double sampled = sampled_distance(p[0], p[1], p[2], p[3]);
        assert_true(found <= sampled + 1e-6 && found > sampled - 0.02);
    }
}

static void grids_find_what_brute_force_finds(void **state)
{
    (void)state;
    OutTree *tree = make_tree(600);
    SegmentGrid *grid = segment_grid_new(tree, NULL);
    assert_non_null(grid);
    int touching = 0;
    for (uint64_t q = 0; q < 400; q++) {
        uint64_t key = random_key(77, q);
        Vec3 a = vec3_scale(place(key), 1.3f); // some beyond the grid
        Vec3 b = vec3_madd(a, random_range(random_key(key, 8), 0.0f, 0.4f),
                           random_direction(random_key(key, 9)));
        float reach = random_range(random_key(key, 10), 0.0f, 0.03f);
        float least = q % 3 ? 0.0f : 0.005f, gap = 0.2f;
        bool touches = false;
        for (int64_t i = 1; i < tree->count; i++) {
            float d = segment_distance(a, b, tree->position[tree->parent[i]], tree->position[i]);
            touches = touches || (tree->radius[i] >= least && d < reach + tree->radius[i]);
            gap = fminf(gap, d - reach - tree->radius[i]);
        }
        assert_true(segment_grid_touches(grid, a, b, reach, least) == touches);
        assert_true(fabsf(segment_grid_gap(grid, a, b, reach, 0.2f) - gap) < 1e-7f);
        touching += touches;
    }
    assert_in_range(touching, 20, 380);
    segment_grid_free(grid);
    out_tree_free(tree);
}

static void trees_without_segments_touch_nothing(void **state)
{
    (void)state;
    OutTree *tree = make_tree(1);
    SegmentGrid *grid = segment_grid_new(tree, NULL);
    assert_non_null(grid);
    assert_false(segment_grid_touches(grid, vec3(0, 0, 0), vec3(1, 1, 1), 9.0f, 0.0f));
    assert_true(segment_grid_gap(grid, vec3(0, 0, 0), vec3(1, 1, 1), 9.0f, 0.5f) == 0.5f);
    segment_grid_free(grid);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_of_segments_are_the_least),
        cmocka_unit_test(grids_find_what_brute_force_finds),
        cmocka_unit_test(trees_without_segments_touch_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
