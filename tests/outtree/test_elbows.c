#include "outtree/elbows.h"
#include "testing.h"

#include "base/exact_math.h"
#include "outtree/out_tree.h"

enum { LIMB = 200, TWIG = 5 }; // nodes

#define THICK 0.5f   // m, of the trunk
#define RADIUS 0.1f  // m, of the limb
#define ALLOWED 0.2f // m for most = 1: sqrt(0.1 * (0.5 - 0.1))

// A limb that winds by so much (m) to either side, with a twig at each tenth node.
static OutTree *winding_limb(float width)
{
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    for (int i = 0; i < LIMB; i++) {
        float sine, cosine, x = 0.05f * (float)i;
        exact_sincos(1.3f * x, &sine, &cosine);
        out_tree_add_node(tree, vec3(x, width * sine, 0), i - 1, i, 0, (uint64_t)i + 1, NULL);
        tree->radius[i] = RADIUS;
    }
    for (int i = 10; i < LIMB; i += 10) {
        int64_t parent = i;
        for (int k = 1; k <= TWIG; k++) {
            Vec3 p = vec3_add(tree->position[i], vec3(0.01f * (float)k, 0, 0.03f * (float)k));
            parent = out_tree_add_node(tree, p, parent, i + k, 0, (uint64_t)(1000 * i + k), NULL);
            tree->radius[parent] = 0.01f;
        }
    }
    return tree;
}

// Places of the limb where it turns by more than two degrees.
static int count_turns(const OutTree *tree)
{
    int turns = 0;
    for (int i = 2; i + 1 < LIMB; i++) {
        Vec3 before = vec3_normalize(vec3_sub(tree->position[i], tree->position[i - 1]));
        Vec3 after = vec3_normalize(vec3_sub(tree->position[i + 1], tree->position[i]));
        turns += vec3_dot(before, after) < 0.9994f;
    }
    return turns;
}

static void narrow_bends_become_straight(void **state)
{
    (void)state;
    OutTree *tree = winding_limb(0.15f);
    assert_true(out_tree_elbows(tree, 1.0f, THICK, NULL));
    Vec3 from = tree->position[1], to = tree->position[LIMB - 1];
    Vec3 way = vec3_normalize(vec3_sub(to, from));
    for (int i = 1; i < LIMB; i++) {
        Vec3 off = vec3_sub(tree->position[i], from);
        assert_true(vec3_length(vec3_madd(off, -vec3_dot(off, way), way)) < 1e-4f);
    }
    out_tree_free(tree);
}

// Bends wider than that stay, as elbows: no node leaves its place by more than is allowed, which
// lies off its way or, where spacing evens out, along it.
static void wide_bends_become_elbows(void **state)
{
    (void)state;
    OutTree *tree = winding_limb(1.0f), *before = winding_limb(1.0f);
    assert_true(out_tree_elbows(tree, 1.0f, THICK, NULL));
    float farthest = 0.0f;
    for (int i = 0; i < LIMB; i++) {
        float nearest = INFINITY; // to the way before
        for (int k = 0; k < LIMB; k++) {
            nearest = fminf(nearest, vec3_distance(tree->position[i], before->position[k]));
        }
        farthest = fmaxf(farthest, nearest);
    }
    assert_true(farthest > 0.5f * ALLOWED && farthest < 1.1f * ALLOWED);
    int turns = count_turns(tree);
    assert_true(turns >= 4 && turns <= 16); // of four and more half waves
    assert_true(count_turns(before) > 60);
    assert_true(vec3_distance(tree->position[0], before->position[0]) == 0.0f);
    assert_true(vec3_distance(tree->position[LIMB - 1], before->position[LIMB - 1]) == 0.0f);
    out_tree_free(tree);
    out_tree_free(before);
}

// Twigs, straight already, move with the node that they grow from and keep their form.
static void what_grows_from_a_limb_goes_along(void **state)
{
    (void)state;
    OutTree *tree = winding_limb(1.0f), *before = winding_limb(1.0f);
    assert_true(out_tree_elbows(tree, 1.0f, THICK, NULL));
    float moved = 0.0f;
    for (int64_t i = LIMB; i < tree->count; i++) {
        int32_t parent = tree->parent[i];
        Vec3 now = vec3_sub(tree->position[i], tree->position[parent]);
        Vec3 then = vec3_sub(before->position[i], before->position[parent]);
        assert_true(vec3_distance(now, then) < 1e-5f);
        moved = fmaxf(moved, vec3_distance(tree->position[i], before->position[i]));
    }
    assert_true(moved > 0.5f * ALLOWED);
    out_tree_free(tree);
    out_tree_free(before);
}

static void without_elbows_nothing_moves(void **state)
{
    (void)state;
    OutTree *tree = winding_limb(1.0f);
    uint64_t hash = out_tree_hash(tree);
    assert_true(out_tree_elbows(tree, 0.0f, THICK, NULL));
    assert_true(out_tree_hash(tree) == hash);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(narrow_bends_become_straight),
        cmocka_unit_test(wide_bends_become_elbows),
        cmocka_unit_test(what_grows_from_a_limb_goes_along),
        cmocka_unit_test(without_elbows_nothing_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
