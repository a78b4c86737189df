// Measures against trees whose numbers are known.
#include "outtree/box_dimension.h"
#include "outtree/branching.h"
#include "outtree/measure.h"
#include "outtree/radii.h"
#include "outtree/strahler.h"
#include "testing.h"

#include "base/exact_math.h"
#include "base/random.h"

#include <math.h>

static double measured(const OutTree *tree, const char *name)
{
    MeasureList list = {0};
    assert_true(out_tree_measure(tree, &list, NULL));
    const Measure *measure = measures_find(&list, name);
    assert_non_null(measure);
    double value = measure->value;
    measures_clear(&list);
    return value;
}

#define assert_near(a, b, tolerance) assert_true(fabs((double)(a) - (double)(b)) <= (tolerance))

static int64_t add(OutTree *tree, Vec3 p, int64_t parent, float radius)
{
    int64_t node = out_tree_add_node(tree, p, parent, 0, 0, (uint64_t)tree->count, NULL);
    assert_true(node >= 0);
    tree->radius[node] = radius;
    return node;
}

// Every branch splits evenly at `angle` to both sides in the plane, lengths and radii shrink by
// fixed factors; each branch is three steps long.
static void add_binary(OutTree *tree, int64_t from, float heading, float length, float radius,
                       int generations, float angle)
{
    int64_t node = from;
    float sine, cosine;
    exact_sincos(heading, &sine, &cosine);
    for (int i = 0; i < 3; i++) {
        node = add(tree, vec3_madd(tree->position[node], length / 3.0f, vec3(sine, cosine, 0)),
                   node, radius);
    }
    if (generations > 1) {
        add_binary(tree, node, heading - angle, 0.7f * length, 0.8f * radius, generations - 1,
                   angle);
        add_binary(tree, node, heading + angle, 0.7f * length, 0.8f * radius, generations - 1,
                   angle);
    }
}

static void a_perfect_binary_tree_has_known_numbers(void **state)
{
    (void)state;
    enum { GENERATIONS = 7 };
    OutTree *tree = out_tree_new(NULL);
    float angle = 37.0f * RADIANS_PER_DEGREE;
    add(tree, vec3(0, 0, 0), -1, 0.1f);
    add_binary(tree, 0, 0.0f, 1.0f, 0.1f, GENERATIONS, angle);
    assert_near(measured(tree, "strahler_order"), GENERATIONS, 0.0);
    assert_near(measured(tree, "horton_number"), 2.0, 1e-9);
    assert_near(measured(tree, "horton_length"), 1.0 / 0.7, 1e-5);
    assert_near(measured(tree, "horton_diameter"), 1.0 / 0.8, 1e-5);
    assert_near(measured(tree, "terminals"), 64, 0.0);
    assert_near(measured(tree, "forks"), 63, 0.0);
    assert_near(measured(tree, "most_children"), 2, 0.0);
    assert_near(measured(tree, "asymmetry"), 0.0, 1e-12);
    assert_near(measured(tree, "branch_angle"), 37.0, 1e-2);
    assert_near(measured(tree, "branch_angle_spread"), 0.0, 0.05);
    assert_near(measured(tree, "main_angle"), 37.0, 1e-2);
    // 2 x 0.8^e = 1
    assert_near(measured(tree, "radius_exponent"), log(2.0) / -log(0.8), 1e-4);
    assert_near(measured(tree, "pipe_residual"), 0.0, 1e-4);
    assert_near(measured(tree, "murray_residual"), 2.0 * 0.512 - 1.0, 1e-4);
    // 1 + 2 (0.7) + 4 (0.7)^2 + ...
    assert_near(measured(tree, "length"), (pow(1.4, GENERATIONS) - 1.0) / 0.4, 1e-4);
    assert_near(measured(tree, "longest_path"), (1.0 - pow(0.7, GENERATIONS)) / 0.3, 1e-5);
    assert_near(measured(tree, "tip_radius"), 0.1 * pow(0.8, GENERATIONS - 1), 1e-6);
    out_tree_free(tree);
}

// A stem of order 2 with single twigs is a fishbone: as uneven as can be.
static void a_fishbone_is_asymmetric(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    int64_t stem = add(tree, vec3(0, 0, 0), -1, 1);
    for (int i = 1; i <= 20; i++) {
        stem = add(tree, vec3(0, (float)i, 0), stem, 1);
        add(tree, vec3(1, (float)i, 0), stem, 0.1f);
    }
    add(tree, vec3(0, 21, 0), stem, 1);
    assert_near(measured(tree, "asymmetry"), 1.0, 1e-12);
    assert_near(measured(tree, "strahler_order"), 2, 0.0);
    assert_near(measured(tree, "horton_number"), 21.0, 1e-9);
    assert_near(measured(tree, "branch_angle"), 90.0, 1e-3);
    assert_near(measured(tree, "main_angle"), 0.0, 1e-3);
    out_tree_free(tree);
}

// Orders by their definition, node by node, children first.
static void strahler_orders_follow_the_definition(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    add(tree, vec3(0, 0, 0), -1, 1);
    for (int i = 1; i < 500; i++) {
        int64_t parent = (int64_t)(random_unit(random_key(7, (uint64_t)i)) * (float)i);
        add(tree, vec3((float)i, 0, 0), parent, 1);
    }
    int32_t order[500];
    out_tree_strahler(tree, order);
    for (int i = 0; i < 500; i++) {
        int highest = 0, many = 0, wanted = 1;
        for (int c = i + 1; c < 500; c++) {
            if (tree->parent[c] == i && order[c] >= highest) {
                many = order[c] == highest ? many + 1 : 1;
                highest = order[c];
            }
        }
        if (highest > 0) {
            wanted = many > 1 ? highest + 1 : highest;
        }
        assert_int_equal(order[i], wanted);
    }
    out_tree_free(tree);
}

static void a_zigzag_turns_and_is_tortuous(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    int64_t node = add(tree, vec3(0, 0, 0), -1, 1);
    for (int i = 1; i <= 100; i++) {
        node = add(tree, vec3((float)i, (float)(i % 2), 0), node, 1);
    }
    assert_near(measured(tree, "turning"), 90.0, 1e-3);
    assert_near(measured(tree, "tortuosity"), sqrt(2.0), 1e-5);
    assert_true(isnan(measured(tree, "branch_angle")));
    assert_true(isnan(measured(tree, "radius_exponent")));
    assert_true(isnan(measured(tree, "horton_number")));
    out_tree_free(tree);
}

static void box_dimensions_of_lines_planes_and_space(void **state)
{
    (void)state;
    static Vec3 points[64 * 64 * 64];
    double dimension;
    int count = 0;
    for (int i = 0; i < 1000; i++) {
        points[count++] = vec3(0.3f * (float)i, 0.7f * (float)i, -0.2f * (float)i);
    }
    assert_true(points_box_dimension(points, count, 2.0, &dimension, NULL));
    assert_near(dimension, 1.0, 0.06);
    count = 0;
    for (int i = 0; i < 256 * 256; i++) {
        points[count++] = vec3((float)(i % 256), 0, (float)(i / 256));
    }
    assert_true(points_box_dimension(points, count, 2.0, &dimension, NULL));
    assert_near(dimension, 2.0, 0.02);
    count = 0;
    for (int i = 0; i < 64 * 64 * 64; i++) {
        points[count++] = vec3((float)(i % 64), (float)(i / 64 % 64), (float)(i / 4096));
    }
    assert_true(points_box_dimension(points, count, 1.0, &dimension, NULL));
    assert_near(dimension, 3.0, 0.02);
    // Sierpinski's triangle by the chaos game: ln 3 / ln 2
    Vec3 p = vec3(0, 0, 0);
    for (int i = 0; i < 200000; i++) {
        static const Vec3 corner[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        int pick = (int)(3.0f * random_unit(random_key(3, (uint64_t)i)));
        p = vec3_lerp(p, corner[pick], 0.5f);
        points[i] = p;
    }
    assert_true(points_box_dimension(points, 200000, 0.004, &dimension, NULL));
    assert_near(dimension, log(3.0) / log(2.0), 0.04);
    assert_true(points_box_dimension(points, 0, 1.0, &dimension, NULL) && isnan(dimension));
    points[1] = points[0];
    assert_true(points_box_dimension(points, 2, 1.0, &dimension, NULL) && isnan(dimension));
}

// The tree itself: a comb that fills a square has dimension 2 down to its own spacing.
static void box_dimension_of_a_comb(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    int64_t stem = add(tree, vec3(0, 0, 0), -1, 1);
    for (int x = 0; x <= 64; x++) {
        stem = x > 0 ? add(tree, vec3((float)x, 0, 0), stem, 1) : stem;
        int64_t node = stem;
        for (int y = 1; y <= 64; y++) {
            node = add(tree, vec3((float)x, (float)y, 0), node, 1);
        }
    }
    double dimension;
    assert_true(out_tree_box_dimension(tree, &dimension, NULL));
    assert_near(dimension, 2.0, 0.05);
    out_tree_free(tree);
}

// The pipe model's radii are measured as what they were made from.
static void the_exponent_of_pipe_radii_is_found(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    add(tree, vec3(0, 0, 0), -1, 0);
    for (int i = 1; i < 400; i++) {
        int64_t parent = (int64_t)(random_unit(random_key(11, (uint64_t)i)) * (float)i);
        add(tree, vec3((float)i, (float)(i * i % 7), (float)(i % 3)), parent, 0);
    }
    for (int e = 2; e <= 3; e++) {
        out_tree_pipe_radii(tree, (float)e, 0.001f, 0.0f);
        assert_near(measured(tree, "radius_exponent"), e, 1e-3);
        assert_near(measured(tree, "pipe_residual"), 0.0, 1e-3);
    }
    assert_near(measured(tree, "murray_residual"), 0.0, 1e-4);
    out_tree_free(tree);
}

static void trees_of_nothing_and_one_node_measure(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    assert_near(measured(tree, "nodes"), 0, 0.0);
    assert_true(isnan(measured(tree, "box_dimension")));
    add(tree, vec3(1, 2, 3), -1, 0);
    assert_near(measured(tree, "nodes"), 1, 0.0);
    assert_near(measured(tree, "terminals"), 1, 0.0);
    assert_near(measured(tree, "height"), 0, 0.0);
    assert_true(isnan(measured(tree, "tortuosity")));
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_perfect_binary_tree_has_known_numbers),
        cmocka_unit_test(a_fishbone_is_asymmetric),
        cmocka_unit_test(strahler_orders_follow_the_definition),
        cmocka_unit_test(a_zigzag_turns_and_is_tortuous),
        cmocka_unit_test(box_dimensions_of_lines_planes_and_space),
        cmocka_unit_test(box_dimension_of_a_comb),
        cmocka_unit_test(the_exponent_of_pipe_radii_is_found),
        cmocka_unit_test(trees_of_nothing_and_one_node_measure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
