#include "base/random.h"
#include "outtree/chains.h"
#include "outtree/jitter.h"
#include "testing.h"

#include <math.h>
#include <string.h>

// A trunk along +X of `steps` nodes 1 m apart, and from its middle a branch along +Z.
static OutTree *make_tee(int64_t steps)
{
    OutTree *tree = out_tree_new(NULL);
    for (int64_t i = 0; i <= steps; i++) {
        out_tree_add_node(tree, vec3((float)i, 0, 0), i - 1, (int32_t)i, 0,
                          random_key(1, (uint64_t)i), NULL);
    }
    int64_t parent = steps / 2;
    for (int64_t i = 1; i <= steps / 4; i++) {
        parent = out_tree_add_node(tree, vec3((float)(steps / 2), 0, (float)i), parent, (int32_t)i,
                                   0, random_key(2, (uint64_t)i), NULL);
    }
    return tree;
}

static void chains_cover_the_tree_once(void **state)
{
    (void)state;
    static const int parent[9] = {-1, 0, 1, 2, 3, 4, 3, 6, 1};
    OutTree *tree = out_tree_new(NULL);
    for (int i = 0; i < 9; i++) {
        out_tree_add_node(tree, vec3(0, (float)i, 0), parent[i], i, 0, (uint64_t)i, NULL);
    }
    ChainSet *chains = out_tree_chains(tree, NULL);
    assert_int_equal(chains->count, 3);
    static const int32_t nodes[11] = {0, 1, 2, 3, 4, 5, 3, 6, 7, 1, 8};
    static const int64_t first[4] = {0, 6, 9, 11};
    assert_memory_equal(chains->node, nodes, sizeof nodes);
    assert_memory_equal(chains->first, first, sizeof first);
    assert_true(chains->parent[0] == -1 && chains->parent[1] == 0 && chains->parent[2] == 0);
    assert_true(chains->order[0] == 0 && chains->order[1] == 1 && chains->order[2] == 1);
    chains_free(chains);
    tree->radius[6] = 1.0f; // the thicker child takes the chain over
    chains = out_tree_chains(tree, NULL);
    assert_int_equal(chains->node[4], 6);
    chains_free(chains);
    out_tree_free(tree);
}

static void resampling_keeps_forks_and_spaces_evenly(void **state)
{
    (void)state;
    OutTree *tree = make_tee(40), *fine = out_tree_resample(tree, 0.3f, NULL);
    assert_true(out_tree_check(fine, NULL));
    int64_t kept = 0;
    for (int64_t i = 0; i < fine->count; i++) {
        Vec3 p = fine->position[i];
        kept += (p.x == 20.0f && p.z == 0.0f) || (p.x == 40.0f) || (p.z == 10.0f) || p.x == 0.0f;
        if (fine->parent[i] >= 0) {
            float d = vec3_distance(p, fine->position[fine->parent[i]]);
            assert_true(d > 0.29f && d < 0.31f);
        }
    }
    assert_int_equal(kept, 4);
    OutTree *coarse = out_tree_resample(fine, 1000.0f, NULL);
    assert_int_equal(coarse->count, 4); // root, fork, two tips
    Error e = {0};
    assert_null(out_tree_resample(tree, 0.0f, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_null(out_tree_resample(tree, 1e-12f, &e));
    out_tree_free(coarse);
    out_tree_free(fine);
    out_tree_free(tree);
}

static void jitter_moves_across_and_keeps_junctions(void **state)
{
    (void)state;
    enum { STEPS = 400 };
    Run run = run_default();
    OutTree *tree = make_tee(STEPS), *again;
    JitterParams params = jitter_params_default();
    params.amplitude = 0.3f;
    assert_true(out_tree_jitter(tree, &params, &run, NULL));
    assert_true(out_tree_check(tree, NULL));
    float most = 0.0f;
    for (int64_t i = 0; i <= STEPS; i++) { // across the trunk, so x stays
        assert_true(fabsf(tree->position[i].x - (float)i) < 1e-4f);
        most = fmaxf(most, fabsf(tree->position[i].y) + fabsf(tree->position[i].z));
    }
    assert_true(most > 3.0f); // 0.3 m (400 / 4)^0.7 is 7.5 m
    Vec3 end = tree->position[STEPS];
    assert_true(tree->position[0].y == 0.0f && end.y == 0.0f && end.z == 0.0f);
    // The branch starts next to its fork and ends where the fork's shift takes its tip.
    Vec3 shift = vec3_sub(tree->position[STEPS / 2], vec3(STEPS / 2, 0, 0));
    Vec3 tip = vec3_add(vec3(STEPS / 2, 0, STEPS / 4), shift);
    assert_true(vec3_distance(tree->position[tree->count - 1], tip) < 1e-4f);
    assert_true(vec3_distance(tree->position[STEPS + 1], tree->position[STEPS / 2]) < 3.0f);
    again = make_tee(STEPS);
    assert_true(out_tree_jitter(again, &params, &run, NULL));
    assert_true(out_tree_hash(again) == out_tree_hash(tree));
    out_tree_free(again);
    out_tree_free(tree);
}

static void pinned_forks_stay(void **state)
{
    (void)state;
    Run run = run_default();
    OutTree *tree = make_tee(100);
    JitterParams params = jitter_params_default();
    params.amplitude = 0.5f;
    params.pin_forks = true;
    assert_true(out_tree_jitter(tree, &params, &run, NULL));
    Vec3 fork = tree->position[50], tip = tree->position[tree->count - 1];
    assert_true(fork.x == 50.0f && fork.y == 0.0f && fork.z == 0.0f);
    assert_true(tip.x == 50.0f && tip.y == 0.0f && tip.z == 25.0f);
    assert_true(tree->position[25].y != 0.0f);
    out_tree_free(tree);
}

// The displacement of a trunk is a bridge of the asked process: its variance at t of T is
// t^2H - Cov(t, T)^2 / T^2H in units of the amplitude.
static void the_displacement_has_the_asked_variance(void **state)
{
    (void)state;
    enum { STEPS = 64, TREES = 400 };
    Run run = run_default();
    JitterParams params = jitter_params_default();
    params.hurst = 0.6f;
    params.amplitude = 0.2f;
    params.reference = 8.0f;
    double sum = 0.0;
    for (uint64_t s = 0; s < TREES; s++) {
        OutTree *tree = make_tee(STEPS);
        params.seed = s;
        assert_true(out_tree_jitter(tree, &params, &run, NULL));
        Vec3 p = tree->position[STEPS / 2];
        sum += 0.5 * ((double)p.y * p.y + (double)p.z * p.z);
        out_tree_free(tree);
    }
    double t = STEPS / 2.0, T = STEPS, h = 1.2;
    double cov = 0.5 * (pow(t, h) + pow(T, h) - pow(T - t, h));
    double exact = (pow(t, h) - cov * cov / pow(T, h)) * 0.04 / pow(8.0, h);
    assert_true(fabs(sum / TREES / exact - 1.0) < 0.2);
}

static void to_sphere(const void *surface, Vec3 *p, Vec3 *normal)
{
    *normal = vec3_normalize(*p);
    *p = vec3_scale(*normal, *(const float *)surface);
}

static void jitter_stays_on_a_surface(void **state)
{
    (void)state;
    enum { STEPS = 300 };
    float radius = 2.0f;
    Run run = run_default();
    OutTree *tree = out_tree_new(NULL);
    for (int i = 0; i <= STEPS; i++) { // half a great circle
        float t = (float)i / STEPS * 3.0f;
        Vec3 n = vec3(sinf(t), cosf(t), 0);
        out_tree_add_node(tree, vec3_scale(n, radius), i - 1, i, 0, (uint64_t)i, NULL);
        tree->normal[i] = n;
    }
    JitterParams params = jitter_params_default();
    params.amplitude = 0.2f;
    params.project = to_sphere;
    params.surface = &radius;
    params.stride = 0.05f;
    assert_true(out_tree_jitter(tree, &params, &run, NULL));
    float most = 0.0f;
    for (int i = 0; i <= STEPS; i++) {
        assert_true(fabsf(vec3_length(tree->position[i]) - radius) < 1e-5f);
        most = fmaxf(most, fabsf(tree->position[i].z));
    }
    assert_true(most > 0.05f);
    out_tree_free(tree);
}

static void nonsense_is_refused(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    OutTree *tree = make_tee(8);
    JitterParams params = jitter_params_default();
    params.hurst = 1.5f;
    assert_false(out_tree_jitter(tree, &params, &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    params.hurst = 0.5f;
    params.amplitude = NAN;
    assert_false(out_tree_jitter(tree, &params, &run, &e));
    int cancelled = 1;
    run.cancelled = &cancelled;
    params.amplitude = 1.0f;
    assert_false(out_tree_jitter(tree, &params, &run, &e));
    assert_int_equal(e.code, ERROR_CANCELLED);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chains_cover_the_tree_once),
        cmocka_unit_test(resampling_keeps_forks_and_spaces_evenly),
        cmocka_unit_test(jitter_moves_across_and_keeps_junctions),
        cmocka_unit_test(pinned_forks_stay),
        cmocka_unit_test(the_displacement_has_the_asked_variance),
        cmocka_unit_test(jitter_stays_on_a_surface),
        cmocka_unit_test(nonsense_is_refused),
    };
    return cmocka_run_group_tests_name("jitter", tests, NULL, NULL);
}
