// Boughs: each node belongs to what grows from the main axis, and places to the bough of the
// nearest node, as a search over all nodes finds it.
#include "objects/common/boughs.h"
#include "testing.h"

#include "base/random.h"

enum { STEM = 40, LIMBS = 12, LIMB = 14, TWIG = 5 };

static int32_t add(OutTree *tree, Vec3 p, int64_t parent, float radius)
{
    int64_t node = out_tree_add_node(tree, p, parent, 0, 0, (uint64_t)tree->count, NULL);
    assert_true(node >= 0);
    tree->radius[node] = radius;
    return (int32_t)node;
}

// A stem with limbs, each with a twig; limb[k] is the first node of limb k.
static OutTree *stem_with_limbs(int32_t limb[LIMBS])
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    for (int i = 0; i < STEM; i++) {
        add(tree, vec3(0, 0.1f * (float)i, 0), i - 1, 0.1f);
    }
    for (int k = 0; k < LIMBS; k++) {
        Vec3 way = random_direction((uint64_t)k);
        int64_t fork = 3 + 3 * k, node = fork;
        for (int i = 1; i <= LIMB; i++) {
            node = add(tree, vec3_madd(tree->position[fork], 0.1f * (float)i, way), node, 0.02f);
            limb[k] = i == 1 ? (int32_t)node : limb[k];
        }
        for (int i = 1; i <= TWIG; i++) {
            Vec3 p = tree->position[limb[k] + 6];
            p.y += 0.04f * (float)i;
            node = add(tree, p, i == 1 ? limb[k] + 6 : node, 0.004f);
        }
    }
    return tree;
}

static void limbs_and_their_twigs_are_boughs(void **state)
{
    (void)state;
    int32_t limb[LIMBS];
    OutTree *tree = stem_with_limbs(limb);
    Boughs boughs;
    assert_true(boughs_init(&boughs, tree, NULL));
    for (int32_t i = 0; i < STEM; i++) {
        assert_int_equal(boughs.bough[i], 0);
    }
    for (int32_t i = STEM; i < tree->count; i++) {
        assert_int_equal(boughs.bough[i], limb[(i - STEM) / (LIMB + TWIG)]);
    }
    boughs_free(&boughs);
    out_tree_free(tree);
}

static void places_belong_to_the_nearest_node(void **state)
{
    (void)state;
    int32_t limb[LIMBS];
    OutTree *tree = stem_with_limbs(limb);
    Boughs boughs;
    assert_true(boughs_init(&boughs, tree, NULL));
    for (uint64_t k = 0; k < 500; k++) {
        int64_t near = (int64_t)(k * 7 % (uint64_t)tree->count), best = 0;
        Vec3 p = vec3_madd(tree->position[near], 0.08f, random_direction(k + 99));
        for (int64_t i = 1; i < tree->count; i++) {
            float here = vec3_distance(p, tree->position[i]);
            best = here < vec3_distance(p, tree->position[best]) ? i : best;
        }
        int32_t found = boughs_nearest(&boughs, p);
        float least = 3e38f; // of the bough found: nodes may lie equally far
        for (int64_t i = 0; i < tree->count; i++) {
            float here = vec3_distance(p, tree->position[i]);
            least = boughs.bough[i] == found && here < least ? here : least;
        }
        assert_true(least == vec3_distance(p, tree->position[best]));
    }
    assert_int_equal(boughs_nearest(&boughs, vec3(1e4f, 0, 0)),
                     boughs_nearest(&boughs, vec3(2e4f, 0, 0)));
    boughs_free(&boughs);
    out_tree_free(tree);
}

static void a_tree_without_nodes_has_no_boughs(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    Boughs boughs;
    assert_true(boughs_init(&boughs, tree, NULL));
    assert_int_equal(boughs_nearest(&boughs, vec3(0, 0, 0)), -1);
    boughs_free(&boughs);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limbs_and_their_twigs_are_boughs),
        cmocka_unit_test(places_belong_to_the_nearest_node),
        cmocka_unit_test(a_tree_without_nodes_has_no_boughs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
