// Trees that grow by light beside others: rivals take each other's light, walls theirs.
#include "scene/build.h"

#include "scene_fixture.h"

#include <stdio.h>
#include <stdlib.h>

#define TREE(NAME, PLACE, MORE)                                                     \
    "  - name: " NAME "\n"                                                          \
    "    tree: {position: [" PLACE "], height: 6, age: 120, light: {seasons: 20}, " \
    "roots: {count: 0}, leaves: {max_count: 0}, trunk: {lean: 0}, skin: {levels: 0}}\n" MORE
#define CONTEST "    contest: {group: wood, gap: 0.1}\n"
#define STAND                                                                         \
    "objects:\n" TREE("a", "-1.6, 0, -1.6", CONTEST) TREE("b", "0, 0, -1.6", CONTEST) \
        TREE("c", "1.6, 0, -1.6", CONTEST) TREE("d", "-1.6, 0, 0", CONTEST)           \
            TREE("middle", "0, 0, 0", CONTEST) TREE("f", "1.6, 0, 0", CONTEST)        \
                TREE("g", "-1.6, 0, 1.6", CONTEST) TREE("h", "0, 0, 1.6", CONTEST)    \
                    TREE("corner", "1.6, 0, 1.6", CONTEST)

static OutTree *grow(const Scene *scene, const char *name, int threads)
{
    Run run = run_default();
    run.threads = threads;
    Error e = {0};
    OutTree *tree = scene_grow_object(scene, scene_find_object(scene, name), &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    return tree;
}

static int ascending(const void *a, const void *b)
{
    float p = *(const float *)a, q = *(const float *)b;
    return (p > q) - (p < q);
}

// Height below which a tenth of the branches' nodes lie.
static float crown_base(const OutTree *tree)
{
    float *height = malloc((size_t)tree->count * sizeof *height);
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] == 1) {
            height[count++] = tree->position[i].y;
        }
    }
    qsort(height, (size_t)count, sizeof *height, ascending);
    float base = height[count / 10];
    free(height);
    return base;
}

static Vec3 mean_of(const OutTree *tree)
{
    Vec3 mean = vec3(0, 0, 0);
    for (int64_t i = 0; i < tree->count; i++) {
        mean = vec3_madd(mean, 1.0f / (float)tree->count, tree->position[i]);
    }
    return mean;
}

// In a stand of three by three the inner tree is bare below and slim, and one at the corner leans
// outward.
static void a_stand_has_bare_stems_inside_and_leans_outward(void **state)
{
    Scene *alone = fixture_read(*state, "objects:\n" TREE("middle", "0, 0, 0", ""));
    Scene *stand = fixture_read(*state, STAND);
    OutTree *free_tree = grow(alone, "middle", 2), *middle = grow(stand, "middle", 2);
    OutTree *corner = grow(stand, "corner", 2);
    Vec3 out = vec3_sub(mean_of(corner), vec3(1.6f, 0, 1.6f));
    assert_true(crown_base(middle) > crown_base(free_tree) + 0.6f);
    assert_true(2 * middle->count < free_tree->count);
    assert_true(out.x > 0.3f && out.z > 0.3f);
    out_tree_free(free_tree);
    out_tree_free(middle);
    out_tree_free(corner);
    scene_free(alone);
    scene_free(stand);
}

static void rivals_grow_the_same_bits_on_any_threads(void **state)
{
    Scene *row = fixture_read(*state, "objects:\n" TREE("a", "-1, 0, 0", CONTEST)
                                          TREE("b", "1, 0, 0", CONTEST));
    OutTree *one = grow(row, "b", 1), *three = grow(row, "b", 3);
    assert_true(out_tree_hash(one) == out_tree_hash(three));
    out_tree_free(one);
    out_tree_free(three);
    scene_free(row);
}

// Trees whose wood does not meet, but whose leaves shade each other: whoever comes first in the
// file, the same bits.
static void the_order_of_trees_does_not_matter(void **state)
{
    static const char FIRST[] = TREE("a", "-4, 0, 0", CONTEST),
                      SECOND[] = TREE("b", "3, 0, 2", CONTEST);
    char text[2][1024];
    snprintf(text[0], sizeof text[0], "objects:\n%s%s", FIRST, SECOND);
    snprintf(text[1], sizeof text[1], "objects:\n%s%s", SECOND, FIRST);
    Scene *one = fixture_read(*state, text[0]), *other = fixture_read(*state, text[1]);
    Scene *alone = fixture_read(*state, "objects:\n" TREE("a", "-4, 0, 0", ""));
    OutTree *tree = grow(one, "a", 2), *same = grow(other, "a", 1), *unshaded = grow(alone, "a", 2);
    assert_true(out_tree_hash(tree) == out_tree_hash(same));
    assert_true(out_tree_hash(tree) != out_tree_hash(unshaded));
    out_tree_free(tree);
    out_tree_free(same);
    out_tree_free(unshaded);
    scene_free(one);
    scene_free(other);
    scene_free(alone);
}

#define WALL                                                                                \
    "  - name: wall\n    shape: {envelope: [{shape: box, size: [0.5, 6, 8], position: [2, " \
    "6, 0]}]}\n"

// No node comes nearer to the wall than its distance, and the crown grows away from it.
static void a_wall_is_kept_clear(void **state)
{
    Scene *scene = fixture_read(
        *state,
        "objects:\n" TREE("a", "0, 0, 0", "    clear_of: [{object: wall, distance: 0.2}]\n") WALL);
    OutTree *tree = grow(scene, "a", 2);
    assert_true(out_tree_bounds(tree).high.x < 1.3f + 1e-3f);
    assert_true(mean_of(tree).x < -0.2f);
    out_tree_free(tree);
    scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_stand_has_bare_stems_inside_and_leans_outward,
                                        fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(rivals_grow_the_same_bits_on_any_threads, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(the_order_of_trees_does_not_matter, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(a_wall_is_kept_clear, fixture_set_up, fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
