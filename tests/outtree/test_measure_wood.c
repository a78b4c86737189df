// Measures of wood against closed forms, on trees made by hand.
#include "outtree/measure_wood.h"

#include "testing.h"

#define PI_D 3.14159265358979

static void assert_near(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance)) {
        fail_msg("%g, not %g", value, wanted);
    }
}

static int64_t add(OutTree *tree, int64_t parent, Vec3 at, float radius)
{
    int64_t node = out_tree_add_node(tree, at, parent, 0, 0, (uint64_t)tree->count, NULL);
    assert_true(node >= 0);
    tree->radius[node] = radius;
    return node;
}

static double value(const MeasureList *list, const char *name)
{
    const Measure *m = measures_find(list, name);
    assert_non_null(m);
    return m->value;
}

// A post of 10 m and radius 0.2 m on ground at height 2. At 4 m a branch of radius 0.1 m leaves it:
// 3 m out along x and 4 m up. At 8 m one of 1 m along -x, of radius 0.05 m. Twigs of 5 mm on both
// do not count, nor what is on them.
static OutTree *post(void)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    int64_t foot = add(tree, -1, vec3(0, 2, 0), 0.2f);
    int64_t low = add(tree, foot, vec3(0, 6, 0), 0.2f);
    int64_t high = add(tree, low, vec3(0, 10, 0), 0.2f);
    int64_t elbow = add(tree, low, vec3(3, 6, 0), 0.1f);
    add(tree, high, vec3(0, 12, 0), 0.2f);
    int64_t end = add(tree, elbow, vec3(3, 10, 0), 0.1f);
    int64_t short_end = add(tree, high, vec3(-1, 10, 0), 0.05f);
    int64_t twig = add(tree, end, vec3(3, 15, 0), 0.005f);
    add(tree, twig, vec3(3, 16, 0), 0.02f);
    add(tree, short_end, vec3(-9, 10, 0), 0.005f);
    return tree;
}

static double frustum(double length, double a, double b)
{
    return PI_D / 3.0 * length * (a * a + a * b + b * b);
}

static void a_post_with_two_branches_is_measured_in_closed_form(void **state)
{
    (void)state;
    MeasureList list = {0};
    OutTree *tree = post();
    assert_true(out_tree_measure_wood(tree, 2.0f, &list, NULL));
    double stem = frustum(10, 0.2, 0.2);
    double branches = frustum(3, 0.2, 0.1) + frustum(4, 0.1, 0.1) + frustum(1, 0.2, 0.05);
    assert_near(value(&list, "diameter"), 0.4, 1e-6);
    assert_near(value(&list, "height_per_diameter"), 25.0, 1e-4);
    assert_near(value(&list, "crown_width_per_height"), 0.5 * 4.0 / 10.0, 1e-6);
    assert_near(value(&list, "branch_per_height"), (10.0 + 3.0 + 4.0 + 1.0) / 10.0, 1e-5);
    assert_near(value(&list, "tips"), 3.0, 0);
    assert_near(value(&list, "path_fraction"), (10.0 + 11.0 + 9.0) / 3.0 / 11.0, 1e-6);
    assert_near(value(&list, "straightness"), 0.5 * (5.0 / 7.0 + 1.0), 1e-6);
    assert_near(value(&list, "limb_straightness"), 5.0 / 7.0, 1e-6); // 7 m of 8 m
    assert_near(value(&list, "stem_share"), stem / (stem + branches), 1e-6);
    assert_near(value(&list, "form_factor"), (stem + branches) / (PI_D / 4.0 * 0.16 * 10.0), 1e-5);
    measures_clear(&list);
    out_tree_free(tree);
}

// A stem that tapers: its diameter at 1.3 m lies between those of the nodes below and above.
static void the_diameter_is_taken_at_breast_height(void **state)
{
    (void)state;
    MeasureList list = {0};
    OutTree *tree = out_tree_new(NULL);
    int64_t foot = add(tree, -1, vec3(0, -0.7f, 0), 0.4f);
    add(tree, foot, vec3(0.5f, 3.3f, 0), 0.2f);
    assert_true(out_tree_measure_wood(tree, 0.0f, &list, NULL));
    assert_near(value(&list, "diameter"), 0.6, 1e-6);
    measures_clear(&list);
    out_tree_free(tree);
}

static void a_shrub_below_breast_height_has_no_diameter(void **state)
{
    (void)state;
    MeasureList list = {0};
    OutTree *tree = out_tree_new(NULL);
    assert_true(out_tree_measure_wood(tree, 0.0f, &list, NULL));
    assert_true(isnan(value(&list, "diameter")) && isnan(value(&list, "stem_share")));
    measures_clear(&list);
    int64_t foot = add(tree, -1, vec3(0, 0, 0), 0.03f);
    add(tree, foot, vec3(0, 1, 0), 0.02f);
    list = (MeasureList){0};
    assert_true(out_tree_measure_wood(tree, 0.0f, &list, NULL));
    assert_true(isnan(value(&list, "diameter")) && isnan(value(&list, "straightness")));
    assert_near(value(&list, "stem_share"), 1.0, 1e-9);
    measures_clear(&list);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_post_with_two_branches_is_measured_in_closed_form),
        cmocka_unit_test(the_diameter_is_taken_at_breast_height),
        cmocka_unit_test(a_shrub_below_breast_height_has_no_diameter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
