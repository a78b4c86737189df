// Properties of growth: determinism, lengths, kill radius, limits, reports, odd inputs.
#include "grow/growth_fixture.h"

#include "base/exact_math.h"

static void same_bits_for_any_number_of_threads(void **state)
{
    (void)state;
    for (int rule = GROW_MEAN; rule <= GROW_SECTORS; rule++) {
        for (int surface = 0; surface < 2; surface++) {
            uint64_t hash = 0;
            for (int threads = 1; threads <= 3; threads++) {
                PointSet *points = surface ? points_on_sphere(20000, 5) : points_in_ball(30000, 5);
                OutTree *tree = tree_from(vec3(0, -1, 0));
                ColonizeParams params = params_auto(points, 0.5f, 1.2f, 4.0f);
                params.rule = (GrowRule)rule;
                params.on_surface = surface;
                params.noise = 0.2f;
                params.max_children = 4;
                params.max_angle = 100.0f;
                GrowReport report = grow_with(tree, points, &params, threads);
                assert_true(report.new_nodes > 4000); // enough for steps that are shared
                if (threads == 1) {
                    hash = out_tree_hash(tree);
                }
                assert_true(hash == out_tree_hash(tree));
                out_tree_free(tree);
                points_free(points);
            }
        }
    }
}

static void field_of_weight_zero_is_plain_growth(void **state)
{
    (void)state;
    Run run = run_default();
    for (int mode = FIELD_STEER; mode <= FIELD_ADDITIVE; mode++) {
        for (int rule = GROW_MEAN; rule <= GROW_SECTORS; rule++) {
            PointSet *points = points_in_ball(2000, 9);
            FieldParams field = field_params_default(FIELD_CURL);
            GuideField *curl =
                guide_field_new(&field, 1, &(FieldSite){.bounds = aabb_empty()}, &run, NULL);
            assert_non_null(curl);
            ColonizeParams params = params_auto(points, 0.5f, 1.5f, 6.0f);
            params.rule = (GrowRule)rule;
            OutTree *plain = tree_from(vec3(0, -1, 0)), *zero = tree_from(vec3(0, -1, 0));
            OutTree *bent = tree_from(vec3(0, -1, 0));
            grow_with(plain, points, &params, 1);
            params.field = curl;
            params.field_mode = (FieldMode)mode;
            grow_with(zero, points, &params, 1);
            assert_same_tree(plain, zero);
            params.field_weight = 0.5f;
            grow_with(bent, points, &params, 1);
            assert_true(out_tree_hash(bent) != out_tree_hash(plain));
            out_tree_free(plain);
            out_tree_free(zero);
            out_tree_free(bent);
            guide_field_free(curl);
            points_free(points);
        }
    }
}

static void every_node_is_a_step_from_its_parent(void **state)
{
    (void)state;
    Run run = run_default();
    FieldParams field = field_params_default(FIELD_VORTEX);
    GuideField *vortex =
        guide_field_new(&field, 1, &(FieldSite){.bounds = aabb_empty()}, &run, NULL);
    for (int surface = 0; surface < 2; surface++) {
        PointSet *points = surface ? points_on_sphere(3000, 2) : points_in_ball(3000, 2);
        OutTree *tree = tree_from(vec3(0, -1, 0));
        ColonizeParams params = params_auto(points, 0.5f, 1.2f, 4.0f);
        params.on_surface = surface;
        params.noise = 0.3f;
        params.tropism = vec3(0, 0.2f, 0.1f);
        params.field = vortex;
        params.field_weight = 0.7f;
        params.min_angle = 25.0f;
        params.max_angle = 70.0f;
        assert_true(grow_with(tree, points, &params, 1).new_nodes > 300);
        for (int64_t i = 1; i < tree->count; i++) {
            float length = vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
            assert_float_equal(length, params.step, 1e-5f * params.step + 3e-7f);
        }
        out_tree_free(tree);
        points_free(points);
    }
    guide_field_free(vortex);
}

static void no_attractor_survives_within_the_kill_radius(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(3000, 4);
    OutTree *tree = tree_from(vec3(0, -1, 0));
    ColonizeParams params = params_auto(points, 0.5f, 1.5f, 6.0f);
    params.max_steps = 12; // leaves many attractors
    GrowReport report = grow_with(tree, points, &params, 2);
    assert_int_equal(report.stop, STOP_MAX_STEPS);
    assert_int_equal(report.steps, 12);
    int64_t outside = 0;
    for (int64_t a = 0; a < points->count; a++) {
        bool killed = false;
        for (int64_t n = 0; n < tree->count && !killed; n++) {
            Vec3 v = vec3_sub(points->position[a], tree->position[n]);
            killed = vec3_dot(v, v) < params.kill * params.kill;
        }
        outside += !killed;
    }
    assert_int_equal(report.attractors_left, outside);
    assert_true(outside > 100 && outside < points->count);
    out_tree_free(tree);
    points_free(points);
}

static void angles_and_children_keep_their_limits(void **state)
{
    (void)state;
    for (int rule = GROW_MEAN; rule <= GROW_SNAP; rule++) {
        PointSet *points = points_in_ball(4000, 6);
        OutTree *tree = tree_from(vec3(0, -1, 0));
        ColonizeParams params = params_auto(points, 0.5f, 1.0f, 5.0f);
        params.rule = (GrowRule)rule;
        params.min_angle = 30.0f;
        params.max_angle = 60.0f;
        params.max_children = 2;
        grow_with(tree, points, &params, 1);
        assert_true(tree->count > 300);
        int *children = calloc((size_t)tree->count, sizeof *children);
        int laterals = 0;
        for (int64_t i = 1; i < tree->count; i++) {
            int32_t parent = tree->parent[i], before = tree->parent[parent];
            bool lateral = children[parent]++ > 0;
            assert_true(children[parent] <= 2);
            if (before >= 0) {
                Vec3 a = vec3_normalize(vec3_sub(tree->position[parent], tree->position[before]));
                Vec3 b = vec3_normalize(vec3_sub(tree->position[i], tree->position[parent]));
                float degrees = exact_acos(vec3_dot(a, b)) / RADIANS_PER_DEGREE;
                assert_true(degrees < 60.1f);
                assert_true(!lateral || degrees > 29.9f);
                laterals += lateral;
            }
        }
        assert_true(laterals > 20);
        free(children);
        out_tree_free(tree);
        points_free(points);
    }
}

// How many children of one parent stand on the same spot.
static int repeated_children(const OutTree *tree, float tolerance)
{
    int repeated = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        for (int64_t j = i + 1; j < tree->count; j++) {
            repeated += tree->parent[i] == tree->parent[j] && tree->parent[i] >= 0 &&
                        vec3_distance(tree->position[i], tree->position[j]) < tolerance;
        }
    }
    return repeated;
}

static void opposing_attractors_do_not_repeat_a_child(void **state)
{
    (void)state;
    PointSet *points = points_empty(1.0, 3);
    points_put(points, vec3(-1, 0.02f, 0), vec3(0, 1, 0));
    points_put(points, vec3(1, 0.02f, 0), vec3(0, 1, 0));
    ColonizeParams params = colonize_params_default();
    params.step = 0.2f, params.kill = 0.3f, params.influence = 2.0f;
    OutTree *tree = tree_from(vec3(0, 0, 0));
    GrowReport report = grow_with(tree, points, &params, 1);
    assert_int_equal(report.stop, STOP_NO_PULL);
    assert_true(report.new_nodes >= 1 && report.new_nodes < 20);
    assert_int_equal(repeated_children(tree, 1e-3f), 0);
    out_tree_free(tree);
    points_free(points);

    points = points_in_ball(3000, 8);
    params = params_auto(points, 0.5f, 1.0f, 4.0f);
    tree = tree_from(vec3(0, -1, 0));
    grow_with(tree, points, &params, 1);
    assert_int_equal(repeated_children(tree, 1e-3f * params.step), 0);
    out_tree_free(tree);
    points_free(points);
}

static void exactly_opposed_attractors_end_growth(void **state)
{
    (void)state;
    PointSet *points = points_empty(1.0, 3);
    points_put(points, vec3(-1, 0, 0), vec3(0, 1, 0));
    points_put(points, vec3(1, 0, 0), vec3(0, 1, 0));
    ColonizeParams params = colonize_params_default();
    params.step = 0.2f, params.kill = 0.3f, params.influence = 2.0f;
    OutTree *tree = tree_from(vec3(0, 0, 0));
    GrowReport report = grow_with(tree, points, &params, 1);
    assert_int_equal(report.new_nodes, 0);
    assert_int_equal(report.stop, STOP_NO_PULL);
    out_tree_free(tree);
    points_free(points);
}

static void stop_reasons_read_as_promised(void **state)
{
    (void)state;
    char text[256];
    PointSet *points = points_empty(1.0, 3);
    points_put(points, vec3(0, 0.31f, 0), vec3(0, 1, 0));
    ColonizeParams params = colonize_params_default();
    params.step = 0.01f, params.kill = 0.02f, params.influence = 0.12f;
    OutTree *tree = tree_from(vec3(0, 0, 0));
    GrowReport report = grow_with(tree, points, &params, 1);
    assert_int_equal(report.stop, STOP_OUT_OF_REACH);
    grow_report_format(&report, &params, text, sizeof text);
    assert_string_equal(text, "no attractor in reach of root 0: influence 0.12 m, nearest "
                              "attractor 0.31 m; raise growth.levels[].influence");

    points_put(points, vec3(0, 0.1f, 0), vec3(0, 1, 0));
    params.max_steps = 3;
    report = grow_with(tree, points, &params, 1);
    grow_report_format(&report, &params, text, sizeof text);
    assert_string_equal(text, "stopped after 3 steps: 3 new nodes, 2 attractors left; raise "
                              "growth.max_steps 3 to grow on");
    params.max_steps = 0;
    params.max_nodes = 6;
    report = grow_with(tree, points, &params, 1);
    assert_int_equal(tree->count, 6);
    grow_report_format(&report, &params, text, sizeof text);
    assert_string_equal(text, "stopped after 2 steps: 2 new nodes, 2 attractors left; raise "
                              "growth.max_nodes 6 to grow on");
    params.max_nodes = 0;
    report = grow_with(tree, points, &params, 1);
    assert_int_equal(report.stop, STOP_NO_PULL);
    grow_report_format(&report, &params, text, sizeof text);
    assert_non_null(strstr(text, "grown until no attractor pulls"));
    out_tree_free(tree);
    points_free(points);
}

static void remember_warning(void *user, const char *message)
{
    strncpy(user, message, 255);
}

static void a_root_out_of_reach_is_warned_about(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(500, 1);
    ColonizeParams params = params_auto(points, 0.5f, 1.5f, 6.0f);
    OutTree *tree = tree_from(vec3(0, -1, 0));
    out_tree_add_node(tree, vec3(0, 9, 0), -1, 0, 1, 3, NULL);
    char warning[256] = "";
    Run run = run_default();
    run.warn = remember_warning;
    run.user = warning;
    assert_true(colonize(tree, points, &params, &run, NULL, NULL));
    assert_non_null(strstr(warning, "no attractor in reach of root 1: influence"));
    assert_non_null(strstr(warning, "; raise growth.levels[].influence"));
    out_tree_free(tree);
    points_free(points);
}

static void bad_lengths_are_errors(void **state)
{
    (void)state;
    const float bad[] = {0.0f, -1.0f, NAN, INFINITY};
    PointSet *points = points_in_ball(10, 1);
    Run run = run_default();
    for (int i = 0; i < 4; i++) {
        for (int which = 0; which < 3; which++) {
            ColonizeParams params = params_auto(points, 0.5f, 1.5f, 6.0f);
            *(which == 0 ? &params.step : which == 1 ? &params.kill : &params.influence) = bad[i];
            OutTree *tree = tree_from(vec3(0, -1, 0));
            Error e = {0};
            assert_false(colonize(tree, points, &params, &run, NULL, &e));
            assert_int_equal(e.code, ERROR_INPUT);
            assert_non_null(strstr(e.message, "it must be at least 1e-12 and at most 1e12 m"));
            assert_int_equal(tree->count, 1);
            out_tree_free(tree);
        }
    }
    points->position[3].y = NAN;
    ColonizeParams params = params_auto(points, 0.5f, 1.5f, 6.0f);
    OutTree *tree = tree_from(vec3(0, -1, 0));
    Error e = {0};
    assert_false(colonize(tree, points, &params, &run, NULL, &e));
    assert_string_equal(e.message, "attractor 3 is not a finite position");
    out_tree_free(tree);
    points_free(points);
}

static void interruption_leaves_a_valid_tree(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(500, 1);
    ColonizeParams params = params_auto(points, 0.5f, 1.5f, 6.0f);
    OutTree *tree = tree_from(vec3(0, -1, 0));
    int cancelled = 1;
    Run run = run_default();
    run.cancelled = &cancelled;
    Error e = {0};
    assert_false(colonize(tree, points, &params, &run, NULL, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    assert_true(out_tree_check(tree, NULL));
    out_tree_free(tree);
    points_free(points);
}

static void odd_inputs_end_well(void **state)
{
    (void)state;
    ColonizeParams params = colonize_params_default();
    params.step = 0.1f, params.kill = 0.25f, params.influence = 1.5f;
    PointSet *points = points_empty(0.0, 3);
    OutTree *tree = tree_from(vec3(0, 0, 0));
    GrowReport report = grow_with(tree, points, &params, 1); // no attractors
    assert_int_equal(report.stop, STOP_OUT_OF_REACH);
    char text[256];
    grow_report_format(&report, &params, text, sizeof text);
    assert_string_equal(text,
                        "there are no attractors to grow toward; raise growth.levels[].attractors");

    points_put(points, vec3(0, 1, 0), vec3(0, 1, 0)); // one
    report = grow_with(tree, points, &params, 1);
    assert_int_equal(report.new_nodes, 8);
    assert_int_equal(report.attractors_left, 0);

    for (int i = 0; i < 100; i++) {
        points_put(points, vec3(1, 0, 0), vec3(0, 1, 0)); // a hundred on one spot
        points_put(points, vec3(0, 0, 0), vec3(0, 1, 0)); // and on top of the root
    }
    report = grow_with(tree, points, &params, 2);
    assert_int_equal(report.attractors_left, 0);
    assert_int_equal(report.new_nodes, 8);
    out_tree_free(tree);
    points_free(points);
}

static void an_influence_beyond_everything_works(void **state)
{
    (void)state;
    PointSet *points = points_in_ball(1000, 12);
    ColonizeParams params = params_auto(points, 0.5f, 1.5f, 1.0f);
    params.influence = 1e6f;
    OutTree *tree = tree_from(vec3(0, -30, 0));
    GrowReport report = grow_with(tree, points, &params, 2);
    assert_int_equal(report.stop, STOP_NO_PULL);
    assert_true(report.attractors_left < 10);
    assert_true(tree->count > 300);
    out_tree_free(tree);
    points_free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bits_for_any_number_of_threads),
        cmocka_unit_test(field_of_weight_zero_is_plain_growth),
        cmocka_unit_test(every_node_is_a_step_from_its_parent),
        cmocka_unit_test(no_attractor_survives_within_the_kill_radius),
        cmocka_unit_test(angles_and_children_keep_their_limits),
        cmocka_unit_test(opposing_attractors_do_not_repeat_a_child),
        cmocka_unit_test(exactly_opposed_attractors_end_growth),
        cmocka_unit_test(stop_reasons_read_as_promised),
        cmocka_unit_test(a_root_out_of_reach_is_warned_about),
        cmocka_unit_test(bad_lengths_are_errors),
        cmocka_unit_test(interruption_leaves_a_valid_tree),
        cmocka_unit_test(odd_inputs_end_well),
        cmocka_unit_test(an_influence_beyond_everything_works),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
