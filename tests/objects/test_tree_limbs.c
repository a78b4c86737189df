// Limbs that leave a trunk go their own ways: none runs close along another or comes back to it
// like a handle.
#include "making.h"
#include "objects/tree/tree.h"
#include "testing.h"

#include <stdlib.h>

static GrowLevel crown_level[] = {{30, 0.10f, 0.4f, 4.0f, 0.70f, 0.3f, 0.0f, 0.5f},
                                  {300, 0.20f, 0.7f, 2.5f, 0.90f, 0.3f, 0.0f, 0.5f},
                                  {3000, 0.30f, 0.9f, 2.2f, 0.97f, 0.3f, 0.0f, 0.5f}};

static OutTree *grow(uint64_t seed)
{
    TreeParams params = tree_params_default();
    params.height = 14.0f;
    params.crown.element.levels = crown_level;
    params.crown.element.level_count = 3;
    params.crown.lobes = 0;
    params.roots.count = 0;
    Error e = {0};
    Run run = run_default();
    OutTree *tree = grow_kind(&kind_tree, &params,
                              &(Recipe){.seed = seed, .label = "oak", .run = &run}, 1.0f, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

// The last node that lies on the ways from the root to both.
static int32_t meeting(const OutTree *tree, int32_t a, int32_t b)
{
    while (a != b) {
        if (a > b) {
            a = tree->parent[a];
        } else {
            b = tree->parent[b];
        }
    }
    return a;
}

// Are two nodes of different limbs, by ways of three times the sum of their radii or more from
// where the limbs part, no further apart between surfaces than the thicker is wide?
static bool is_handle(const OutTree *tree, const float *way, int32_t a, int32_t b)
{
    float sum = tree->radius[a] + tree->radius[b];
    float most = tree->radius[a] > tree->radius[b] ? tree->radius[a] : tree->radius[b];
    if (vec3_distance(tree->position[a], tree->position[b]) > sum + 2.0f * most) {
        return false;
    }
    int32_t fork = meeting(tree, a, b);
    return tree->colony[fork] == TREE_TRUNK && way[a] - way[fork] > 3.0f * sum &&
           way[b] - way[fork] > 3.0f * sum;
}

// Nodes of limbs, a tenth as thick as the trunk or more, that come close to another limb.
static int count_handles(const OutTree *tree)
{
    int32_t *limb = malloc((size_t)tree->count * sizeof *limb);
    float *way = calloc((size_t)tree->count, sizeof *way);
    assert_true(limb && way);
    int count = 0, handles = 0;
    for (int32_t i = 1; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        way[i] = way[parent] + vec3_distance(tree->position[i], tree->position[parent]);
        if (tree->colony[i] == TREE_CROWN && tree->radius[i] > 0.1f * tree->radius[12]) {
            limb[count++] = i;
        }
    }
    for (int i = 0; i < count; i++) {
        bool found = false;
        for (int k = 0; k < i && !found; k++) {
            found = is_handle(tree, way, limb[i], limb[k]);
        }
        handles += found;
    }
    free(limb);
    free(way);
    return handles;
}

static int count_limbs(const OutTree *tree)
{
    int count = 0;
    for (int64_t i = 1; i < tree->count; i++) {
        count += tree->colony[i] == TREE_CROWN && tree->colony[tree->parent[i]] == TREE_TRUNK &&
                 tree->radius[i] > 0.1f * tree->radius[12];
    }
    return count;
}

static void limbs_form_no_handles(void **state)
{
    (void)state;
    int trees = 0, handles = 0, limbs = 0, seeds = 24;
    for (uint64_t seed = 1; seed <= (uint64_t)seeds; seed++) {
        OutTree *tree = grow(seed);
        int found = count_handles(tree);
        handles += found;
        trees += found > 0;
        limbs += count_limbs(tree);
        out_tree_free(tree);
    }
    if (handles > 0) {
        fail_msg("%d of %d trees have handles, of %d nodes", trees, seeds, handles);
    }
    assert_in_range(limbs, 3 * seeds, 6 * seeds); // thinned out, not cut down
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limbs_form_no_handles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
