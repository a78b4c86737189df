// Trees that grow by light beside others: rivals take each other's light, walls theirs.
#include "scene/build.h"

#include "scene_fixture.h"

#include <pthread.h>
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
    OutTree *free_tree = fixture_grow(alone, "middle", 2),
            *middle = fixture_grow(stand, "middle", 2);
    OutTree *corner = fixture_grow(stand, "corner", 2);
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

#define ROW "objects:\n" TREE("a", "-1, 0, 0", CONTEST) TREE("b", "1, 0, 0", CONTEST)

static void rivals_grow_the_same_bits_on_any_threads(void **state)
{
    Scene *row = fixture_read(*state, ROW), *other = fixture_read(*state, ROW);
    OutTree *one = fixture_grow(row, "b", 1), *three = fixture_grow(other, "b", 3);
    assert_true(out_tree_hash(one) == out_tree_hash(three));
    out_tree_free(one);
    out_tree_free(three);
    scene_free(row);
    scene_free(other);
}

static void count_report(void *user, const char *stage, double done)
{
    (void)stage, (void)done;
    ++*(int *)user;
}

// What the first object asked for has grown is there for the others, for measures and for a world.
static void a_contest_grows_once(void **state)
{
    Scene *row = fixture_read(*state, ROW);
    int reports = 0;
    Run run = run_default();
    run.progress = count_report;
    run.user = &reports;
    OutTree *a = scene_grow_object(row, 0, &run, NULL);
    assert_true(a && reports > 20); // one a season at least
    reports = 0;
    OutTree *b = scene_grow_object(row, 1, &run, NULL);
    MeasureList list = {0};
    assert_true(b && scene_measure(row, 1, &run, &list, NULL));
    assert_int_equal(reports, 0);
    assert_true(out_tree_hash(a) != out_tree_hash(b));
    measures_clear(&list);
    out_tree_free(a);
    out_tree_free(b);
    scene_free(row);
}

typedef struct Asking {
    const Scene *scene;
    const char *name;
    uint64_t hash;
} Asking;

static void *ask(void *user)
{
    Asking *asking = user;
    Run run = run_default();
    OutTree *tree = scene_grow_object(asking->scene, scene_find_object(asking->scene, asking->name),
                                      &run, NULL);
    asking->hash = tree ? out_tree_hash(tree) : 0;
    out_tree_free(tree);
    return NULL;
}

// Two threads that ask one scene at once get what each gets alone.
static void threads_may_ask_at_once(void **state)
{
    Scene *row = fixture_read(*state, ROW), *other = fixture_read(*state, ROW);
    Asking asking[2] = {{.scene = row, .name = "a"}, {.scene = row, .name = "b"}};
    pthread_t thread[2];
    for (int i = 0; i < 2; i++) {
        assert_int_equal(pthread_create(&thread[i], NULL, ask, &asking[i]), 0);
    }
    for (int i = 0; i < 2; i++) {
        pthread_join(thread[i], NULL);
        OutTree *tree = fixture_grow(other, asking[i].name, 1);
        assert_true(asking[i].hash == out_tree_hash(tree));
        out_tree_free(tree);
    }
    scene_free(row);
    scene_free(other);
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
    OutTree *tree = fixture_grow(one, "a", 2), *same = fixture_grow(other, "a", 1),
            *unshaded = fixture_grow(alone, "a", 2);
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
    OutTree *tree = fixture_grow(scene, "a", 2);
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
        cmocka_unit_test_setup_teardown(a_contest_grows_once, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(threads_may_ask_at_once, fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(the_order_of_trees_does_not_matter, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(a_wall_is_kept_clear, fixture_set_up, fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
