// Joining tips: who joins whom, small loops refused, everything one piece in the end.
#include "testing.h"

#include "outtree/join.h"

#include <math.h>

static int64_t add(OutTree *tree, float x, float y, int64_t parent, int32_t birth)
{
    int64_t i =
        out_tree_add_node(tree, vec3(x, y, 0), parent, birth, 0, (uint64_t)tree->count + 1, NULL);
    assert_true(i >= 0);
    tree->normal[i] = vec3(0, 0, 1);
    return i;
}

static int64_t join(OutTree *tree, JoinParams params)
{
    Error e = {0};
    int64_t joins;
    Run run = run_default();
    assert_true(out_tree_join_tips(tree, &params, &joins, &run, &e));
    assert_true(out_tree_check(tree, &e));
    return joins;
}

static int64_t pieces(const OutTree *tree)
{
    int64_t count;
    assert_true(out_tree_count_pieces(tree, &count, NULL, NULL));
    return count;
}

// Two branches that face each other over a gap of 1.
static OutTree *facing(void)
{
    OutTree *tree = out_tree_new(NULL);
    for (int k = 0; k < 4; k++) {
        add(tree, (float)k, 0, k - 1, k);
    }
    for (int k = 0; k < 4; k++) {
        add(tree, 7.0f - (float)k, 0, k == 0 ? -1 : tree->count - 1, 2 * k);
    }
    return tree;
}

static void two_tips_join_once(void **state)
{
    (void)state;
    OutTree *tree = facing();
    assert_int_equal(pieces(tree), 2);
    assert_int_equal(join(tree, (JoinParams){.reach = 1.5f, .least_path = 3.0f}), 1);
    assert_int_equal(pieces(tree), 1);
    assert_int_equal(tree->parent[8], 3);
    assert_true(vec3_distance(tree->position[8], tree->position[7]) == 0.0f);
    assert_int_equal(tree->birth[8], 7); // after both ends: 3 and 6
    out_tree_free(tree);
}

static void reach_heading_and_normal_are_kept_to(void **state)
{
    (void)state;
    OutTree *tree = facing();
    assert_int_equal(join(tree, (JoinParams){.reach = 0.9f}), 0);
    for (int64_t i = 4; i < 8; i++) {
        tree->normal[i] = vec3(0, 0, -1); // the other side of a sheet
    }
    assert_int_equal(join(tree, (JoinParams){.reach = 1.5f, .least_path = 9.0f}), 0);
    out_tree_free(tree);
}

static void a_tip_does_not_join_its_own_branch(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    int64_t last = -1; // a horseshoe whose end comes back to its start
    for (int k = 0; k <= 10; k++) {
        float t = 0.58f * (float)k;
        last = add(tree, cosf(t), sinf(t), last, k);
    }
    JoinParams params = {.reach = 0.6f, .least_path = 100.0f, .least_cosine = -1.0f};
    assert_int_equal(join(tree, params), 0);
    params.least_path = 2.0f;
    assert_int_equal(join(tree, params), 1);
    assert_true(vec3_distance(tree->position[11], tree->position[0]) == 0.0f);
    out_tree_free(tree);
}

static void all_becomes_one(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    for (int k = 0; k < 5; k++) { // parallel sticks: no tip heads for another
        int64_t root = add(tree, 3.0f * (float)(k * k), 0, -1, 0);
        add(tree, 3.0f * (float)(k * k), 5, root, 1);
    }
    JoinParams params = {.reach = 1.0f, .all_one = true};
    assert_int_equal(join(tree, params), 4);
    assert_int_equal(pieces(tree), 1);
    out_tree_free(tree);
}

// Two squares that share a side, drawn as a tree: the last node of each lies on an earlier one.
static void loops_are_counted_where_ends_meet(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    const float x[] = {0, 1, 1, 0, 0}, y[] = {0, 0, 1, 1, 0};
    for (int k = 0; k < 5; k++) {
        add(tree, x[k], y[k], k - 1, k);
    }
    int64_t count, loops;
    assert_true(out_tree_count_pieces(tree, &count, &loops, NULL));
    assert_int_equal(loops, 1);
    int64_t corner = add(tree, 2, 0, 1, 2);
    corner = add(tree, 2, 1, corner, 3);
    assert_true(out_tree_count_pieces(tree, &count, &loops, NULL));
    assert_int_equal(loops, 1);
    add(tree, 1, 1, corner, 4);
    add(tree, 9, 9, -1, 0); // apart
    assert_true(out_tree_count_pieces(tree, &count, &loops, NULL));
    assert_int_equal(count, 2);
    assert_int_equal(loops, 2);
    out_tree_free(tree);
}

// Two long branches of one tree side by side: a ladder whose rungs are `spacing` apart, none of
// them in the corner where the way around would be too short, each a loop.
static void sides_are_bridged_at_even_distances(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    add(tree, 0, 0, -1, 0);
    int64_t left = 0, right = 0;
    for (int k = 1; k <= 20; k++) {
        left = add(tree, 0, (float)k, left, k);
        right = add(tree, 1, (float)k, right, k);
    }
    int64_t nodes = tree->count, count, loops;
    JoinParams params = {.reach = 1.2f, .least_path = 5.0f, .least_cosine = 0.9f};
    assert_int_equal(join(tree, params), 0); // the tips head past each other
    params.spacing = 4.0f;
    int64_t joins = join(tree, params);
    assert_true(joins == 4); // at 4, 8, 12 and 16, not at the tips
    for (int64_t i = nodes; i < tree->count; i++) {
        Vec3 from = tree->position[tree->parent[i]], to = tree->position[i];
        assert_true(from.y == to.y && fabsf(from.x - to.x) == 1.0f);
        assert_true(fmodf(from.y, 4.0f) == 0.0f);
    }
    assert_true(out_tree_count_pieces(tree, &count, &loops, NULL));
    assert_int_equal(count, 1);
    assert_int_equal(loops, 4);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_tips_join_once),
        cmocka_unit_test(reach_heading_and_normal_are_kept_to),
        cmocka_unit_test(a_tip_does_not_join_its_own_branch),
        cmocka_unit_test(all_becomes_one),
        cmocka_unit_test(loops_are_counted_where_ends_meet),
        cmocka_unit_test(sides_are_bridged_at_even_distances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
