// From the text of a scene to what grew: control points bend growth where they are, limits of
// angles and children hold on the grown tree.
#include "scene_fixture.h"

#include "base/exact_math.h"
#include "scene/build.h"

#include <math.h>

enum { CROWN = 1 }; // colony of a tree's crown

// A bush whose crown has one level and the keys given.
static OutTree *grow_bush(Fixture *fixture, const char *growth, const char *fields)
{
    char text[1024];
    int size = snprintf(text, sizeof text,
                        "objects:\n"
                        "  - name: bush\n"
                        "    tree:\n"
                        "      height: 4\n"
                        "      leaves: {max_count: 0}\n"
                        "      roots: {count: 0}\n"
                        "      crown:\n"
                        "        lobes: 0\n"
                        "        growth: {%s, levels: [{attractors: 1500, step: 0.3, relax: 0}]}\n"
                        "        fields: [%s]\n",
                        growth, fields);
    Error e = {0};
    Run run = run_default();
    run.threads = 1;
    Scene *scene = scene_read(fixture_write(fixture, "bush.yaml", text, (size_t)size), NULL, 0, &e);
    OutTree *tree = scene ? scene_grow_object(scene, 0, &run, &e) : NULL;
    if (!tree) {
        fail_msg("%s:%d: %s", e.file, e.line, e.message);
    }
    scene_free(scene);
    return tree;
}

// Mean share of x in the directions of the steps that end within (or beyond) `reach` of the center.
static double mean_x(const OutTree *tree, Vec3 center, float reach, bool within)
{
    double sum = 0.0, count = 0.0;
    for (int64_t i = 0; i < tree->count; i++) {
        if (tree->colony[i] != CROWN || tree->parent[i] < 0 ||
            (vec3_distance(tree->position[i], center) < reach) != within) {
            continue;
        }
        Vec3 step = vec3_sub(tree->position[i], tree->position[tree->parent[i]]);
        sum += (double)vec3_normalize(step).x;
        count += 1.0;
    }
    assert_true(count > 30.0);
    return sum / count;
}

static void a_control_point_bends_growth_near_it(void **state)
{
    const Vec3 center = vec3(0, 3, 1);
    OutTree *plain = grow_bush(*state, "field_weight: 0", "");
    for (int side = -1; side <= 1; side += 2) {
        char point[160];
        snprintf(point, sizeof point,
                 "{kind: point, center: [0, 3, 1], vector: [%d, 0, 0], scale: 1.2}", side);
        OutTree *bent = grow_bush(*state, "field_weight: 3", point);
        OutTree *weightless = grow_bush(*state, "field_weight: 0", point);
        assert_true(out_tree_hash(weightless) == out_tree_hash(plain));
        double near = mean_x(bent, center, 0.6f, true) - mean_x(plain, center, 0.6f, true);
        double far = mean_x(bent, center, 1.5f, false) - mean_x(plain, center, 1.5f, false);
        assert_true(side * near > 0.3); // of unit vectors
        assert_true(fabs(far) < 0.25 * fabs(near));
        out_tree_free(bent);
        out_tree_free(weightless);
    }
    out_tree_free(plain);
}

typedef struct Limits {
    int most_children;
    double least_side, most; // degrees: of a later child, of any child
    int64_t sides;
} Limits;

// Of what grew in the crown; its branches' first, planted nodes have no birth.
static Limits measure_limits(const OutTree *tree)
{
    Limits limits = {.least_side = 180.0};
    int *children = calloc((size_t)tree->count, sizeof *children);
    for (int64_t i = 0; i < tree->count; i++) {
        int32_t parent = tree->parent[i], before = parent < 0 ? -1 : tree->parent[parent];
        if (before < 0 || tree->colony[before] != CROWN) {
            continue;
        }
        Vec3 a = vec3_normalize(vec3_sub(tree->position[parent], tree->position[before]));
        Vec3 b = vec3_normalize(vec3_sub(tree->position[i], tree->position[parent]));
        double degrees = (double)(exact_acos(vec3_dot(a, b)) / RADIANS_PER_DEGREE);
        limits.most = fmax(limits.most, degrees);
        if (++children[parent] > 1) {
            limits.least_side = fmin(limits.least_side, degrees);
            limits.sides++;
        }
        limits.most_children =
            children[parent] > limits.most_children ? children[parent] : limits.most_children;
    }
    free(children);
    return limits;
}

static void limits_hold_on_the_grown_tree(void **state)
{
    OutTree *wide = grow_bush(*state, "max_children: 3, min_angle: 0, max_angle: 90", "");
    OutTree *tight = grow_bush(*state, "max_children: 2, min_angle: 30, max_angle: 50", "");
    OutTree *single = grow_bush(*state, "max_children: 1", "");
    Limits free_ones = measure_limits(wide), limits = measure_limits(tight);
    assert_true(free_ones.most_children >= 2 && free_ones.most_children <= 3);
    assert_true(free_ones.most > 55.0 && free_ones.most < 90.1);
    assert_true(free_ones.least_side < 29.0);
    assert_int_equal(limits.most_children, 2);
    assert_true(limits.most < 50.1);
    assert_true(limits.least_side > 29.9);
    assert_true(limits.sides > 20);
    assert_int_equal(measure_limits(single).most_children, 1);
    out_tree_free(wide);
    out_tree_free(tight);
    out_tree_free(single);
}

// The out-tree's hash of an object alone in its scene.
static uint64_t hash_of(Fixture *fixture, const char *object)
{
    char text[512];
    int size = snprintf(text, sizeof text, "objects:\n  - name: a\n    %s\n", object);
    Error e = {0};
    Run run = run_default();
    Scene *scene = scene_read(fixture_write(fixture, "a.yaml", text, (size_t)size), NULL, 0, &e);
    OutTree *tree = scene ? scene_grow_object(scene, 0, &run, &e) : NULL;
    if (!tree) {
        fail_msg("%s:%d: %s", e.file, e.line, e.message);
    }
    uint64_t hash = out_tree_hash(tree);
    out_tree_free(tree);
    scene_free(scene);
    return hash;
}

static void fields_that_are_listed_bend_growth(void **state)
{
    static const struct {
        const char *head, *tail; // of the object, around its one field
    } objects[] = {
        {"tree: {crown: {lobes: 0, growth: {levels: [{attractors: 80}]}, fields: [", "]}}"},
        {"lightning: {height: 10, fields: [", "]}"},
        {"lightning: {points: {place: surface}, branching: 0.2, envelope: [{shape: sphere, size: "
         "1}], fields: [",
         "]}"},
        {"sculpture: {attractors: 30, fields: [", "]}"},
        {"fracture: {attractors: 30, fields: [", "]}"},
        {"forest: {stands: 1, stand_trees: 1, growth: {levels: [{attractors: 80}]}, fields: [",
         "]}"},
        {"vessels: {terminals: 60, envelope: [{shape: sphere, size: 0.1}], fields: [", "]}"},
        {"terrain: {resolution: 64, rivers: {count: 200, fields: [", "]}}"}};
    const char *field = "{kind: uniform, vector: [1, 0, 0]";
    for (size_t i = 0; i < sizeof objects / sizeof objects[0]; i++) {
        char none[256], one[256];
        snprintf(none, sizeof none, "%s%s, weight: 0}%s", objects[i].head, field, objects[i].tail);
        snprintf(one, sizeof one, "%s%s}%s", objects[i].head, field, objects[i].tail);
        if (hash_of(*state, none) == hash_of(*state, one)) {
            fail_msg("%s: the field does nothing", one);
        }
    }
}

// Nuclei that are named change what grows, and the elements' own nodes are the default.
static void nuclei_that_are_named_bend_growth(void **state)
{
    static const char *const nuclei[] = {
        "", ", nuclei: [{kind: point, position: [0, 4, 0]}]",
        ", nuclei: [{kind: line, position: [0, 0, 0], end: [0, 9, 0]}]",
        ", nuclei: [{kind: surface, envelope: [{shape: sphere, size: 0.5, position: [0, 5, 0]}]}]"};
    for (int k = 0; k < 2; k++) {
        uint64_t hash[4];
        for (int i = 0; i < 4; i++) {
            char object[400];
            snprintf(object, sizeof object,
                     "tree: {height: 8, crown: {lobes: 0, growth: {levels: [{attractors: 80}]}, "
                     "fields: [{kind: %s, turn: 90%s}]}}",
                     k == 0 ? "nuclei" : "grid, resolution: 24", nuclei[i]);
            hash[i] = hash_of(*state, object);
            for (int j = 0; j < i; j++) {
                assert_true(hash[i] != hash[j]);
            }
        }
    }
}

// The field is turned about the normal of the start point, unless the field has an axis itself.
static void the_normal_of_a_start_turns_the_field(void **state)
{
    for (int axis = 0; axis < 2; axis++) {
        uint64_t hash[2];
        for (int normal = 0; normal < 2; normal++) {
            char object[400];
            snprintf(
                object, sizeof object,
                "outtree: {placed: {points: [{position: [0, -0.9, 0], group: 0%s}]}, envelope: "
                "[{shape: sphere, size: 1}], growth: {levels: [{attractors: 80}]}, fields: "
                "[{kind: nuclei, turn: 90%s}]}",
                normal ? ", normal: [1, 0, 0]" : "", axis ? ", vector: [0, 0, 1]" : "");
            hash[normal] = hash_of(*state, object);
        }
        assert_true((hash[0] == hash[1]) == (axis == 1));
    }
}

// The height is shared out among the internodes of free growth: without any there is none.
static void a_tree_that_does_not_grow_by_light_is_refused(void **state)
{
    static const char *const ways[] = {"light", "both"};
    for (int i = 0; i < 2; i++) {
        char text[256];
        int size = snprintf(text, sizeof text,
                            "objects:\n"
                            "  - name: bush\n"
                            "    tree: {height: 3, grown_by: %s,\n"
                            "           light: {vigor: 0, seasons: 6, tropism: [0, -1, 0]},\n"
                            "           crown: {growth: {levels: [{attractors: 60}]}}}\n",
                            ways[i]);
        Error e = {0};
        Run run = run_default();
        Scene *scene =
            scene_read(fixture_write(*state, "bush.yaml", text, (size_t)size), NULL, 0, &e);
        assert_non_null(scene);
        assert_null(scene_grow_object(scene, 0, &run, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_non_null(strstr(e.message, "increase light.vigor"));
        scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_control_point_bends_growth_near_it, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(limits_hold_on_the_grown_tree, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(fields_that_are_listed_bend_growth, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(the_normal_of_a_start_turns_the_field, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(nuclei_that_are_named_bend_growth, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(a_tree_that_does_not_grow_by_light_is_refused,
                                        fixture_set_up, fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
