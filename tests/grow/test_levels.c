// Coarse-to-fine growth: births, relaxation, reports, and what levels are for.
#include "grow/growth_fixture.h"

#include "shape/envelope.h"

static const GrowLevel oak[3] = {
    {.attractors = 30,
     .step = 0.10f,
     .kill = 0.4f,
     .influence = 4.0f,
     .scale = 0.7f,
     .noise = 0.3f},
    {.attractors = 300,
     .step = 0.20f,
     .kill = 0.7f,
     .influence = 2.5f,
     .scale = 0.9f,
     .noise = 0.3f},
    {.attractors = 3000,
     .step = 0.30f,
     .kill = 0.9f,
     .influence = 2.2f,
     .scale = 1.0f,
     .noise = 0.3f,
     .tropism = 0.5f},
};

static Envelope *unit_sphere(void)
{
    Shape shape = {.kind = SHAPE_SPHERE, .size = {1, 1, 1}, .transform = transform_identity()};
    EnvelopeParams params = {.shapes = &shape, .shape_count = 1};
    Run run = run_default();
    Envelope *envelope = envelope_new(&params, &run, NULL);
    assert_non_null(envelope);
    return envelope;
}

static OutTree *grow_levels(const Envelope *envelope, float relax, int threads,
                            GrowReport reports[3])
{
    GrowLevel levels[3];
    for (int i = 0; i < 3; i++) {
        levels[i] = oak[i];
        levels[i].relax = relax;
    }
    OutTree *tree = tree_from(vec3(0, -1.2f, 0));
    ScatterParams scatter = scatter_params_default();
    ColonizeParams params = colonize_params_default();
    params.max_children = 3;
    params.tropism = vec3(0, 0.2f, 0);
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    if (!colonize_levels(tree, envelope, &scatter, levels, 3, &params, &run, reports, &e)) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, NULL));
    return tree;
}

static void levels_go_on_where_the_last_one_ended(void **state)
{
    (void)state;
    Envelope *envelope = unit_sphere();
    GrowReport reports[3];
    OutTree *tree = grow_levels(envelope, 0.0f, 1, reports);
    int64_t first = 1, births = 0;
    for (int level = 0; level < 3; level++) {
        assert_int_equal(reports[level].stop, STOP_NO_PULL);
        assert_true(reports[level].new_nodes > 50);
        for (int64_t i = first; i < first + reports[level].new_nodes; i++) {
            assert_true(tree->birth[i] > births);
            assert_true(tree->birth[i] <= births + reports[level].steps);
        }
        first += reports[level].new_nodes;
        births += reports[level].steps;
    }
    assert_int_equal(first, tree->count);
    out_tree_free(tree);
    envelope_free(envelope);
}

static void relaxing_moves_nodes_halfway_to_their_parents(void **state)
{
    (void)state;
    Envelope *envelope = unit_sphere();
    GrowLevel level = oak[1];
    ScatterParams scatter = scatter_params_default();
    ColonizeParams params = colonize_params_default();
    Run run = run_default();
    OutTree *plain = tree_from(vec3(0, -1.2f, 0)), *relaxed = tree_from(vec3(0, -1.2f, 0));
    assert_true(colonize_levels(plain, envelope, &scatter, &level, 1, &params, &run, NULL, NULL));
    level.relax = 0.5f;
    assert_true(colonize_levels(relaxed, envelope, &scatter, &level, 1, &params, &run, NULL, NULL));
    assert_int_equal(plain->count, relaxed->count);
    assert_true(plain->count > 100);
    for (int64_t i = 1; i < plain->count; i++) {
        Vec3 middle = vec3_lerp(plain->position[i], plain->position[plain->parent[i]], 0.5f);
        assert_float_equal(vec3_distance(middle, relaxed->position[i]), 0.0f, 1e-6f);
    }
    out_tree_free(plain);
    out_tree_free(relaxed);
    envelope_free(envelope);
}

static void levels_have_the_same_bits_on_any_number_of_threads(void **state)
{
    (void)state;
    Envelope *envelope = unit_sphere();
    GrowReport reports[3];
    OutTree *one = grow_levels(envelope, 0.5f, 1, reports);
    OutTree *two = grow_levels(envelope, 0.5f, 2, reports);
    OutTree *three = grow_levels(envelope, 0.5f, 3, reports);
    assert_true(out_tree_hash(one) == out_tree_hash(two));
    assert_true(out_tree_hash(one) == out_tree_hash(three));
    out_tree_free(one);
    out_tree_free(two);
    out_tree_free(three);
    envelope_free(envelope);
}

// Straightness of the way from every tip to the root: what tells a broom from an oak.
static double straightness(const OutTree *tree)
{
    double sum = 0.0;
    int64_t tips = 0;
    int *children = calloc((size_t)tree->count, sizeof *children);
    for (int64_t i = tree->count - 1; i > 0; i--) {
        children[tree->parent[i]]++;
        if (children[i] == 0) {
            double length = 0.0;
            for (int64_t j = i; tree->parent[j] >= 0; j = tree->parent[j]) {
                length += (double)vec3_distance(tree->position[j], tree->position[tree->parent[j]]);
            }
            sum += (double)vec3_distance(tree->position[i], tree->position[0]) / length;
            tips++;
        }
    }
    free(children);
    return sum / (double)tips;
}

static void levels_make_gnarled_limbs(void **state)
{
    (void)state;
    Envelope *envelope = unit_sphere();
    GrowReport reports[3];
    OutTree *by_levels = grow_levels(envelope, 0.5f, 1, reports);
    OutTree *at_once = tree_from(vec3(0, -1.2f, 0));
    ScatterParams scatter = scatter_params_default();
    ColonizeParams params = colonize_params_default();
    GrowLevel level = oak[2];
    level.influence = 6.0f;
    level.noise = 0.0f;
    Run run = run_default();
    assert_true(colonize_levels(at_once, envelope, &scatter, &level, 1, &params, &run, NULL, NULL));
    assert_true(straightness(by_levels) < 0.9 * straightness(at_once));
    out_tree_free(by_levels);
    out_tree_free(at_once);
    envelope_free(envelope);
}

static void wrong_levels_are_errors(void **state)
{
    (void)state;
    Envelope *envelope = unit_sphere();
    ScatterParams scatter = scatter_params_default();
    ColonizeParams params = colonize_params_default();
    Run run = run_default();
    OutTree *tree = tree_from(vec3(0, -1.2f, 0));
    Error e = {0};
    GrowLevel level = oak[0];
    level.attractors = 0;
    assert_false(colonize_levels(tree, envelope, &scatter, &level, 1, &params, &run, NULL, &e));
    assert_string_equal(e.message, "level 1 has 0 attractors; give it at least 1");
    level = oak[0];
    level.relax = 2.0f;
    assert_false(colonize_levels(tree, envelope, &scatter, &level, 1, &params, &run, NULL, &e));
    assert_string_equal(e.message, "level 1 relaxes by 2; it must be 0 to 1");
    assert_int_equal(tree->count, 1);
    out_tree_free(tree);
    envelope_free(envelope);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_go_on_where_the_last_one_ended),
        cmocka_unit_test(relaxing_moves_nodes_halfway_to_their_parents),
        cmocka_unit_test(levels_have_the_same_bits_on_any_number_of_threads),
        cmocka_unit_test(levels_make_gnarled_limbs),
        cmocka_unit_test(wrong_levels_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
