// What befalls trees, beside the same trees without hazards: node by node, as ids do not change.
#include "making.h"
#include "objects/tree/by_light.h"
#include "objects/tree/hazards.h"
#include "testing.h"

#include <math.h>
#include <stdlib.h>

enum { TREES = 24 };

static TreeParams conifer(void)
{
    TreeParams params = tree_params_default();
    params.height = 12.0f;
    params.roots.count = 0;
    params.leaves.max_count = 500;
    params.light.mature_height = 12.0f;
    LightParams *growth = &params.light.growth;
    growth->seasons = 12;
    growth->apical_control = (Vec2){0.68f, 0.66f};
    growth->whorl = 5;
    growth->shoot = vec3(6.0f, 2.5f, 1.6f);
    growth->light_need = 0.1f;
    growth->leaf_seasons = 5;
    growth->branch_angle = vec3(90.0f, 50.0f, 45.0f);
    growth->plagiotropy = 0.85f;
    growth->bole = 0.0f;
    growth->snags = 0.0f; // stubs would count as dead limbs
    return params;
}

static OutTree *grow(const TreeParams *params, uint64_t seed)
{
    Error e = {0};
    Run run = run_default();
    OutTree *tree = grow_kind(&kind_tree, params,
                              &(Recipe){.seed = seed, .label = "spruce", .run = &run}, 1.0f, &e);
    if (!tree || !out_tree_check(tree, &e)) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static OutTree *grow_with(HazardParams hazards, uint64_t seed)
{
    TreeParams params = conifer();
    params.hazards = hazards;
    return grow(&params, seed);
}

static bool is_limb(const OutTree *tree, int64_t i)
{
    return tree->colony[i] == TREE_CROWN && tree->parent[i] >= 0 &&
           tree->colony[tree->parent[i]] == TREE_TRUNK;
}

static int64_t find(const OutTree *tree, uint64_t id)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->id[i] == id) {
            return i;
        }
    }
    return -1;
}

static float first_length(const OutTree *tree, int64_t limb)
{
    return vec3_distance(tree->position[limb], tree->position[tree->parent[limb]]);
}

static double deviation(const double *value, int count)
{
    double mean = 0.0, squares = 0.0;
    for (int i = 0; i < count; i++) {
        mean += value[i] / count;
    }
    for (int i = 0; i < count; i++) {
        squares += (value[i] - mean) * (value[i] - mean) / (count - 1);
    }
    return sqrt(squares);
}

// Logarithms of the factors on limbs: their mean differs from tree to tree, they within a tree.
static void crowns_differ_in_width_by_the_deviation(void **state)
{
    (void)state;
    double mean[TREES], within = 0.0;
    for (int k = 0; k < TREES; k++) {
        OutTree *plain = grow_with((HazardParams){0}, (uint64_t)k);
        OutTree *tree = grow_with((HazardParams){.width = 0.2f}, (uint64_t)k);
        double factor[500];
        int count = 0;
        mean[k] = 0.0;
        for (int64_t i = 0; i < tree->count && count < 500; i++) {
            if (is_limb(tree, i)) {
                float old = first_length(plain, find(plain, tree->id[i]));
                factor[count] = log((double)(first_length(tree, i) / old));
                mean[k] += factor[count++];
            }
        }
        assert_true(count > 20);
        mean[k] /= count;
        within += deviation(factor, count) / TREES;
        out_tree_free(plain);
        out_tree_free(tree);
    }
    double between = deviation(mean, TREES);
    assert_true(between > 0.13 && between < 0.28); // 0.2 of 24 trees: 0.14 to 0.26 in 95 %
    assert_true(within > 0.08 && within < 0.12);   // half of it, of many limbs
}

// A neighbour shortens limbs on its side and leaves those of the other side alone.
static void neighbours_hold_back_one_side(void **state)
{
    (void)state;
    int free_standing = 0, one_sided = 0;
    for (uint64_t k = 0; k < TREES; k++) {
        OutTree *plain = grow_with((HazardParams){0}, k);
        OutTree *tree = grow_with((HazardParams){.crowding = 0.6f}, k);
        float least = 1.0f, most = 0.0f;
        for (int64_t i = 0; i < tree->count; i++) {
            if (is_limb(tree, i) && tree->position[tree->parent[i]].y < 5.0f) {
                float old = first_length(plain, find(plain, tree->id[i]));
                float factor = first_length(tree, i) / old;
                assert_true(factor > 0.4f * 0.4f * 0.4f && factor < 1.001f);
                least = fminf(least, factor);
                most = fmaxf(most, factor);
            }
        }
        free_standing += least > 0.999f;
        one_sided += least < 0.7f && most > 0.95f;
        out_tree_free(plain);
        out_tree_free(tree);
    }
    assert_in_range(free_standing, 1, 10); // one in five
    assert_true(one_sided > TREES / 2);
}

static int count_limbs(const OutTree *tree)
{
    int count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        count += is_limb(tree, i) && tree->position[tree->parent[i]].y < 0.88f * 12.0f;
    }
    return count;
}

static void limbs_are_lost_by_their_mean_share(void **state)
{
    (void)state;
    double lost[TREES], mean = 0.0;
    for (int k = 0; k < TREES; k++) {
        OutTree *plain = grow_with((HazardParams){0}, (uint64_t)k);
        OutTree *tree = grow_with((HazardParams){.lost_limbs = 0.3f}, (uint64_t)k);
        lost[k] = 1.0 - (double)count_limbs(tree) / count_limbs(plain);
        mean += lost[k] / TREES;
        out_tree_free(plain);
        out_tree_free(tree);
    }
    assert_true(mean > 0.2 && mean < 0.4); // evenly from 0 to 0.6
    assert_true(deviation(lost, TREES) > 0.11 && deviation(lost, TREES) < 0.24);
}

// Limbs turn about their bases: their lengths stay.
static void limbs_hang_and_leave_their_whorls(void **state)
{
    (void)state;
    OutTree *plain = grow_with((HazardParams){0}, 3);
    OutTree *tree = grow_with((HazardParams){.angle = 12.0f, .loosening = 1.0f}, 3);
    assert_int_equal(tree->count, plain->count);
    int moved = 0, limbs = 0, turned = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i], old = plain->parent[i];
        if (!is_limb(tree, i)) {
            assert_int_equal(parent, old);
            continue;
        }
        assert_float_equal(first_length(tree, i), first_length(plain, i), 1e-4);
        assert_true(tree->position[parent].y <= plain->position[old].y);
        limbs++;
        moved += parent != old;
        float rise = plain->position[i].y - plain->position[old].y;
        turned += fabsf(tree->position[i].y - tree->position[parent].y - rise) > 0.005f;
    }
    assert_true(limbs > 20 && moved > limbs / 2 && moved < limbs);
    assert_true(turned > limbs / 2);
    out_tree_free(plain);
    out_tree_free(tree);
}

static void the_top_dies_or_forks(void **state)
{
    (void)state;
    OutTree *tree = grow_with((HazardParams){.dead_top = 1.0f}, 2);
    float living = 0.0f, dead = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        float *top = tree->colony[i] == TREE_SNAGS ? &dead : &living;
        *top = tree->colony[i] == TREE_CROWN ? *top : fmaxf(*top, tree->position[i].y);
    }
    assert_true(living > 0.6f * 12.0f && living <= 0.93f * 12.0f && dead > living + 0.3f);
    out_tree_free(tree);

    tree = grow_with((HazardParams){.forked_top = 1.0f}, 2);
    bool *goes_on = calloc((size_t)tree->count, sizeof *goes_on);
    int tops = 0;
    for (int64_t i = tree->count - 1; i > 0; i--) {
        tops += tree->colony[i] == TREE_TRUNK && !goes_on[i];
        goes_on[tree->parent[i] < 0 ? 0 : tree->parent[i]] |= tree->colony[i] == TREE_TRUNK;
        assert_int_equal(find(tree, tree->id[i]), i); // ids are unique
    }
    assert_int_equal(tops, 2);
    free(goes_on);
    out_tree_free(tree);
}

// A dead tree is bare: bark and dead wood alone.
static void dead_trees_bear_no_leaves(void **state)
{
    (void)state;
    TreeParams params = conifer();
    params.hazards.dead = 1.0f;
    OutTree *tree = grow(&params, 5);
    int snags = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(tree->colony[i] != TREE_CROWN);
        snags += tree->colony[i] == TREE_SNAGS;
    }
    assert_true(snags > 20);
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 5, .label = "spruce", .run = &run};
    Geometry geometry = {0};
    int dead_parts = 0;
    Grown grown = grown_of(tree);
    Placing placing = placing_in(&geometry, &recipe);
    assert_true(kind_tree.geometry(&params, &grown, &placing, &e));
    for (int64_t i = 0; i < geometry.count; i++) {
        assert_int_not_equal(geometry.part[i].material, TREE_LEAF);
        dead_parts += geometry.part[i].material == TREE_DEADWOOD;
    }
    assert_in_range(dead_parts, 1, 2); // skin and curves
    geometry_clear(&geometry);
    out_tree_free(tree);
}

// Trees of a stand have the same fortunes.
static void hazards_befall_a_stand(void **state)
{
    (void)state;
    enum { COUNT = 3 };
    TreeParams params[COUNT];
    StandTree tree[COUNT];
    for (int i = 0; i < COUNT; i++) {
        params[i] = conifer();
        params[i].hazards.dead = i == 1 ? 1.0f : 0.0f;
        tree[i] = (StandTree){.params = &params[i], .foot = vec3(6.0f * (float)i, 0, 0), .seed = 7};
    }
    Error e = {0};
    Run run = run_default();
    Recipe recipe = {.seed = 1, .label = "stand", .run = &run};
    assert_true(tree_grow_stand(tree, COUNT, NULL, 0, &recipe, &e));
    for (int i = 0; i < COUNT; i++) {
        assert_int_equal(tree_is_dead(tree[i].grown, &(HazardParams){.dead = 1.0f}), i == 1);
        assert_true(out_tree_check(tree[i].grown, &e));
        out_tree_free(tree[i].grown);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crowns_differ_in_width_by_the_deviation),
        cmocka_unit_test(neighbours_hold_back_one_side),
        cmocka_unit_test(limbs_are_lost_by_their_mean_share),
        cmocka_unit_test(limbs_hang_and_leave_their_whorls),
        cmocka_unit_test(the_top_dies_or_forks),
        cmocka_unit_test(dead_trees_bear_no_leaves),
        cmocka_unit_test(hazards_befall_a_stand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
