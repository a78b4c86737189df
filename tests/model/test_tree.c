#include "model/foliage.h"
#include "model/ground.h"
#include "model/tree.h"
#include "testing.h"

#include <string.h>

static GrowLevel small_levels[] = {{30, 0.10f, 0.4f, 4.0f, 0.70f, 0.3f, 0.0f, 0.5f},
                                   {300, 0.20f, 0.7f, 2.5f, 0.95f, 0.3f, 0.0f, 0.5f}};

static TreeParams small_tree(void)
{
    TreeParams params = tree_params_default();
    params.crown.element.levels = small_levels;
    params.crown.element.level_count = 2;
    params.leaves.max_count = 500;
    params.radii.tip = 0.01f;
    params.leaves.twig_radius = 0.03f;
    return params;
}

static OutTree *grow(const TreeParams *params, uint64_t seed, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    OutTree *tree = tree_grow(params, seed, "oak", &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static void a_tree_has_trunk_crown_and_roots(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *tree = grow(&params, 4, 1);
    Error e = {0};
    assert_true(out_tree_check(tree, &e));
    int64_t count[3] = {0};
    float top = 0.0f, lowest_branch = 1e9f, deepest = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        assert_in_range(tree->colony[i], 0, 2);
        count[tree->colony[i]]++;
        float y = tree->position[i].y;
        top = y > top ? y : top;
        deepest = y < deepest ? y : deepest;
        int32_t parent = tree->parent[i];
        if (tree->colony[i] == 1 && parent >= 0 && tree->colony[parent] == 0) {
            lowest_branch = y < lowest_branch ? y : lowest_branch;
        }
        if (parent >= 0 && tree->colony[i] == tree->colony[parent] && tree->colony[i] == 1) {
            assert_true(tree->radius[i] <= tree->radius[parent] * 1.0001f);
        }
        assert_true(tree->radius[i] > 0.0f);
    }
    assert_true(count[0] > 10 && count[1] > 200 && count[2] > 50);
    assert_true(top > 0.8f * params.height && top < 1.1f * params.height);
    // No branch below the share of the trunk that the scene keeps bare.
    assert_true(lowest_branch > 0.9f * params.crown.branch_from * 0.32f * params.height);
    assert_true(deepest < -0.1f);
    out_tree_free(tree);
}

static void the_same_seed_gives_the_same_tree_for_any_threads(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *one = grow(&params, 4, 1), *two = grow(&params, 4, 2), *other = grow(&params, 5, 1);
    assert_true(out_tree_hash(one) == out_tree_hash(two));
    assert_true(out_tree_hash(one) != out_tree_hash(other));
    out_tree_free(one);
    out_tree_free(two);
    out_tree_free(other);
}

// Ten times the size with no other number: the same form. Rounding may move a few nodes, so compare
// the extents.
static void a_larger_tree_has_the_same_form(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *small = grow(&params, 4, 1);
    params.height *= 10.0f;
    OutTree *large = grow(&params, 4, 1);
    double ratio = (double)large->count / (double)small->count;
    assert_true(ratio > 0.8 && ratio < 1.25);
    Vec3 a = out_tree_bounds(small).high, b = out_tree_bounds(large).high;
    assert_true(fabsf(b.y / a.y - 10.0f) < 0.7f);
    out_tree_free(small);
    out_tree_free(large);
}

static void leaves_sit_on_their_twigs(void **state)
{
    (void)state;
    TreeParams params = small_tree();
    OutTree *tree = grow(&params, 4, 1);
    Error e = {0};
    Run run = run_default();
    Geometry geometry = {0};
    TreeMaterials materials = {0, 1, 2};
    assert_true(tree_geometry(tree, &params, &materials, 0, 4, &geometry, &run, &e));
    int64_t leaves = 0;
    CurveSet *twigs = NULL;
    for (int64_t p = 0; p < geometry.count; p++) {
        if (geometry.part[p].kind == PART_CURVES) {
            twigs = geometry.part[p].curves;
        }
        leaves += geometry.part[p].instance_count;
    }
    assert_non_null(twigs);
    assert_in_range(leaves, params.leaves.max_count * 8 / 10, params.leaves.max_count * 12 / 10);
    for (int64_t p = 0; p < geometry.count; p++) {
        for (int64_t i = 0; i < geometry.part[p].instance_count; i += 17) {
            const Transform *t = &geometry.part[p].instance[i];
            Vec3 base = vec3(t->m[0][3], t->m[1][3], t->m[2][3]);
            float nearest = 1e9f;
            for (int64_t c = 0; c < twigs->curve_count; c++) {
                for (int64_t k = twigs->first[c]; k + 1 < twigs->first[c + 1]; k++) {
                    Vec3 a = twigs->position[k], ab = vec3_sub(twigs->position[k + 1], a);
                    float s = vec3_dot(vec3_sub(base, a), ab) / vec3_dot(ab, ab);
                    Vec3 foot = vec3_madd(a, clampf(s, 0, 1), ab);
                    float gap = vec3_distance(base, foot) - twigs->radius[k];
                    nearest = gap < nearest ? gap : nearest;
                }
            }
            assert_true(nearest <= 0.0f); // the stalk's base is inside the bark
        }
    }
    geometry_clear(&geometry);
    out_tree_free(tree);
}

static void grass_stands_on_the_ground(void **state)
{
    (void)state;
    GroundParams params = ground_params_default();
    params.grass_tufts = 600;
    params.fallen_leaves = 40;
    Error e = {0};
    Run run = run_default();
    Geometry geometry = {0};
    GroundMaterials materials = {0, 1, 2};
    assert_true(ground_geometry(&params, &materials, 0, 9, &geometry, &run, &e));
    int64_t tufts = 0;
    for (int64_t p = 1; p < geometry.count; p++) {
        for (int64_t i = 0; i < geometry.part[p].instance_count; i++) {
            const Transform *t = &geometry.part[p].instance[i];
            float above = t->m[1][3] - ground_height(&params, 9, t->m[0][3], t->m[2][3]);
            assert_true(above >= -1e-4f && above < 0.1f);
            tufts += geometry.part[p].material == 1;
        }
    }
    assert_in_range(tufts, 200, 600);
    const Mesh *land = geometry.part[0].mesh;
    for (int64_t i = 0; i < land->vertex_count; i++) {
        assert_true(land->normal[i].y > 0.5f);
    }
    geometry_clear(&geometry);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tree_has_trunk_crown_and_roots),
        cmocka_unit_test(the_same_seed_gives_the_same_tree_for_any_threads),
        cmocka_unit_test(a_larger_tree_has_the_same_form),
        cmocka_unit_test(leaves_sit_on_their_twigs),
        cmocka_unit_test(grass_stands_on_the_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
