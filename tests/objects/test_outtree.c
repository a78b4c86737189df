// General out-trees: start points and attractors where the user puts them, every rule, on surfaces
// and in volumes, radii by their rules, the record of attractors.
#include "making.h"
#include "testing.h"

#include "objects/outtree/outtree.h"
#include "outtree/crossings.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/export_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// Reads a scene with one outtree of these keys.
static Scene *read_outtree(const char *keys, Error *e)
{
    char text[2048];
    snprintf(text, sizeof text, "seed: 3\nobjects:\n  - name: a\n    outtree: {%s}\n", keys);
    return scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, e);
}

static OutTree *grow_on(const char *keys, int threads)
{
    Error e = {0};
    Run run = run_default();
    run.threads = threads;
    Scene *scene = read_outtree(keys, &e);
    OutTree *tree = scene ? scene_grow_object(scene, 0, &run, &e) : NULL;
    if (!tree) {
        fail_msg("%s: %s", keys, e.message);
    }
    assert_true(out_tree_check(tree, &e));
    scene_free(scene);
    return tree;
}

static OutTree *grow(const char *keys)
{
    return grow_on(keys, 1);
}

static void expect_error(const char *keys, const char *wanted)
{
    Error e = {0};
    Scene *scene = read_outtree(keys, &e);
    assert_null(scene);
    if (!strstr(e.message, wanted)) {
        fail_msg("%s: '%s' instead of '%s'", keys, e.message, wanted);
    }
}

static int64_t count_roots(const OutTree *tree)
{
    int64_t roots = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        roots += tree->parent[i] < 0;
    }
    return roots;
}

static float nearest(const OutTree *tree, Vec3 p)
{
    float best = INFINITY;
    for (int64_t i = 0; i < tree->count; i++) {
        best = fminf(best, vec3_distance(tree->position[i], p));
    }
    return best;
}

// Tanaka et al., section 4.2: the start point and the attractors are where they were put, and the
// snap reading takes the attractors themselves as nodes.
static void placed_points_are_starts_and_attractors(void **state)
{
    (void)state;
    static const Vec3 at[4] = {{0, 1, 0}, {1, 1.5f, 0}, {-1, 1.5f, 0.5f}, {0.2f, 2.5f, 0}};
    static const char points[] =
        "placed: {points: [{position: [0, 0, 0]}, {position: [0, 1, 0], group: 1}, {position: [1, "
        "1.5, 0], group: 1}, {position: [-1, 1.5, 0.5], group: 1}, {position: [0.2, 2.5, 0], "
        "group: 1}], kill: 0.3, step: 0.2, influence: 4}";
    char keys[1024];
    OutTree *tree = grow(points);
    assert_int_equal(count_roots(tree), 1);
    assert_true(vec3_length(tree->position[0]) == 0.0f);
    for (int i = 0; i < 4; i++) {
        assert_true(nearest(tree, at[i]) < 0.3f);
    }
    for (int64_t i = 1; i < tree->count; i++) {
        float step = vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
        assert_float_equal(step, 0.2f, 1e-5);
    }
    out_tree_free(tree);
    snprintf(keys, sizeof keys, "%s, growth: {rule: snap}", points);
    tree = grow(keys);
    assert_int_equal(tree->count, 5);
    for (int i = 0; i < 4; i++) {
        assert_true(nearest(tree, at[i]) == 0.0f);
    }
    out_tree_free(tree);
}

static void starts_lie_apart_on_the_surface(void **state)
{
    (void)state;
    OutTree *tree = grow("starts: {count: 6, direction: [0, 1, 0]}, growth: {levels: [{attractors: "
                         "50}]}");
    assert_int_equal(count_roots(tree), 6);
    assert_true(tree->position[0].y > 0.95f);
    for (int64_t i = 0; i < 6; i++) {
        assert_true(tree->parent[i] == -1 && tree->colony[i] == i);
        assert_float_equal(vec3_length(tree->position[i]), 1.0f, 2e-3);
        assert_true(vec3_dot(tree->position[i], tree->normal[i]) < -0.9f); // into the volume
        for (int64_t k = 0; k < i; k++) { // an octahedron's corners are sqrt(2) apart
            assert_true(vec3_distance(tree->position[i], tree->position[k]) > 0.9f);
        }
    }
    out_tree_free(tree);
}

static void growth_stays_on_the_surface(void **state)
{
    (void)state;
    OutTree *tree = grow("points: {place: surface}, lift: 0.02, jitter: {amplitude: 0.1, segment: "
                         "0.03}, growth: {levels: [{attractors: 400}]}");
    assert_true(tree->count > 200);
    for (int64_t i = 0; i < tree->count; i++) {
        assert_float_equal(vec3_length(tree->position[i]), 1.02f, 2e-3);
        assert_true(vec3_dot(tree->normal[i], vec3_normalize(tree->position[i])) > 0.999f);
    }
    out_tree_free(tree);
}

// Few attractors, far apart, pull through the body; growth goes around it.
static void distant_attractors_do_not_lead_off_the_surface(void **state)
{
    (void)state;
    OutTree *tree = grow("points: {place: surface}, growth: {noise: 0, levels: [{attractors: 12, "
                         "step: 0.1, kill: 0.4, influence: 6, relax: 0}]}");
    float lowest = 1.0f, highest = -1.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        assert_float_equal(vec3_length(tree->position[i]), 1.0f, 1e-3);
        lowest = fminf(lowest, tree->position[i].y);
        highest = fmaxf(highest, tree->position[i].y);
    }
    assert_true(lowest < -0.9f && highest > 0.5f);
    out_tree_free(tree);
}

// A second search for crossings finds none.
static void crystals_do_not_cross(void **state)
{
    (void)state;
    static const char keys[] =
        "points: {place: surface}, crossings: %s, starts: {count: 5}, growth: {rule: sectors, "
        "sector_axis: true, max_angle: 61, levels: [{attractors: 2000, step: 0.5, kill: 0.9, "
        "influence: 5, relax: 0}]}";
    char text[512];
    Run run = run_default();
    snprintf(text, sizeof text, keys, "true");
    OutTree *any = grow(text);
    snprintf(text, sizeof text, keys, "false");
    OutTree *none = grow(text);
    int64_t before = any->count, count = none->count;
    assert_true(out_tree_drop_crossings(any, &run, NULL));
    assert_true(any->count < before);
    assert_true(out_tree_drop_crossings(none, &run, NULL));
    assert_int_equal(none->count, count);
    out_tree_free(any);
    out_tree_free(none);
}

typedef struct Shown {
    int64_t parts, balls, curves; // balls: instances of all parts
    float least, largest;         // m, radii of balls
} Shown;

static Shown show(const char *keys)
{
    Error e = {0};
    Run run = run_default();
    Scene *scene = read_outtree(keys, &e);
    World *world = scene ? scene_build(scene, &run, NULL, &e) : NULL;
    if (!world) {
        fail_msg("%s: %s", keys, e.message);
    }
    Shown shown = {.parts = world->geometry.count, .least = INFINITY};
    for (int64_t i = 0; i < world->geometry.count; i++) {
        const Part *part = &world->geometry.part[i];
        shown.balls += part->instance_count;
        for (int64_t k = 0; k < part->instance_count; k++) {
            float radius = part->instance[k].m[0][0];
            shown.least = radius < shown.least ? radius : shown.least;
            shown.largest = radius > shown.largest ? radius : shown.largest;
        }
        shown.curves += part->curves ? part->curves->curve_count : 0;
    }
    world_free(world);
    scene_free(scene);
    return shown;
}

#define CROSS_POINTS                                                                             \
    "placed: {points: [{position: [0, 0, 0]}, {position: [1, 0, 0], group: 1}, {position: [-1, " \
    "0, 0.1], "                                                                                  \
    "group: 1}, {position: [0, 1, 0.2], group: 1}, {position: [0, -1, -0.1], group: 1}], kill: " \
    "0.2, "                                                                                      \
    "influence: 2}"

// Of four attractors around a start point: all are there before the first step, none at the end.
static void growth_itself_can_be_seen(void **state)
{
    (void)state;
    Shown at_first = show(CROSS_POINTS ", form: none, growth: {rule: snap, max_steps: 1}, show: "
                                       "{attractors: 0.1, nodes: 0.1, starts: 0.1, edges: 0.01}");
    assert_int_equal(at_first.balls, 3 + 2 + 1); // the first step reaches one
    assert_int_equal(at_first.curves, 1);
    Shown at_end = show(CROSS_POINTS ", form: none, growth: {rule: snap}, show: {attractors: 0.1, "
                                     "nodes: 0.1, kill: 0.01, influence: 0.01, pulls: 0.01}");
    assert_int_equal(at_end.balls, 5);
    assert_true(at_end.curves >= 2); // circles about each tip
    Shown pulls = show(CROSS_POINTS ", form: none, growth: {max_nodes: 1}, show: {pulls: 0.01}");
    assert_int_equal(pulls.curves, 4);
    Shown band =
        show("form: none, voxel: 0.1, growth: {levels: [{attractors: 9}]}, show: {band: 0.02}");
    assert_true(band.parts == 2 && band.balls > 100);
}

// Before growth all attractors but those within the kill distance of the start are left.
static void attractors_can_be_exported(void **state)
{
    (void)state;
    static const char text[] =
        "grow_to: 0\nobjects:\n  - name: a\n    outtree: {envelope: [{shape: "
        "sphere, size: 0.5, position: [2, 0, 7]}], points: {place: surface}, "
        "growth: {levels: [{attractors: 100}]}}\n  - {name: b, shape: "
        "{envelope: [{shape: sphere}]}}\n";
    char line[256], file[] = "/tmp/ramify_attractors_XXXXXX.csv";
    Error e = {0};
    Run run = run_default();
    ExportOptions options = {0};
    int handle = mkstemps(file, 4), count = 0;
    assert_true(handle >= 0);
    close(handle);
    Scene *scene = scene_read_text(text, strlen(text), "s.yaml", "", NULL, 0, &e);
    if (!scene || !scene_export(scene, file, &options, &run, NULL, &e)) {
        fail_msg("%s", e.message);
    }
    FILE *stream = fopen(file, "r");
    assert_non_null(fgets(line, sizeof line, stream));
    assert_string_equal(line, "object,x,y,z,nx,ny,nz\n");
    while (fgets(line, sizeof line, stream)) {
        Vec3 p, n;
        assert_int_equal(
            sscanf(line, "\"a\",%f,%f,%f,%f,%f,%f", &p.x, &p.y, &p.z, &n.x, &n.y, &n.z), 6);
        p = vec3_sub(p, vec3(2, 0, 7));
        assert_float_equal(vec3_length(p), 0.5f, 1e-3);
        assert_true(vec3_dot(vec3_normalize(p), n) > 0.99f);
        count++;
    }
    assert_true(count > 90 && count <= 100);
    fclose(stream);
    unlink(file);
    scene_free(scene);
}

static void tips_bear_lamps(void **state)
{
    (void)state;
    OutTree *tree = grow("growth: {levels: [{attractors: 100}]}");
    int64_t tips = tree->count;
    for (int64_t i = 0; i < tree->count; i++) {
        bool bears = false;
        for (int64_t k = i + 1; k < tree->count; k++) {
            bears = bears || tree->parent[k] == i;
        }
        tips -= bears;
    }
    assert_int_equal(show("growth: {levels: [{attractors: 100}]}, lamps: {max_count: 1000}").balls,
                     tips);
    assert_int_equal(show("growth: {levels: [{attractors: 100}]}, lamps: {max_count: 7}").balls, 7);
    Shown even = show("growth: {levels: [{attractors: 100}]}, lamps: {max_count: 99, radius: 0.1}");
    assert_true(even.least == 0.1f && even.largest == 0.1f);
    Shown uneven = show("growth: {levels: [{attractors: 100}]}, lamps: {max_count: 99, radius: "
                        "0.1, variation: 0.8}");
    assert_int_equal(uneven.balls, even.balls);
    assert_true(uneven.least >= 0.02f && uneven.least < 0.04f);
    assert_true(uneven.largest <= 0.1f && uneven.largest > 0.08f);
    out_tree_free(tree);
}

static void every_rule_grows_and_threads_do_not_show(void **state)
{
    (void)state;
    static const char *const rules[] = {"mean", "snap", "sectors", "string"};
    for (int place = 0; place < 2; place++) {
        for (int i = 0; i < 4; i++) {
            char keys[512];
            snprintf(
                keys, sizeof keys,
                "points: {place: %s}, growth: {rule: %s, levels: [{attractors: 400, step: 0.7, "
                "kill: 0.75, influence: 4}]}",
                place ? "surface" : "volume", rules[i]);
            OutTree *one = grow_on(keys, 1), *three = grow_on(keys, 3);
            assert_true(one->count > 40);
            assert_true(out_tree_hash(one) == out_tree_hash(three));
            out_tree_free(one);
            out_tree_free(three);
        }
    }
}

// The strings of axiom F alone give a stalk without forks; the paper's rule forks.
static void a_string_says_where_branches_go(void **state)
{
    (void)state;
    OutTree *stalk = grow("growth: {rule: string, noise: 0, levels: [{attractors: 500, step: 0.7, "
                          "kill: 0.75, influence: 4, relax: 0}]}, string: {axiom: X, rules: 'X -> "
                          "FX', generations: 8, group: 360}");
    for (int64_t i = 0; i < stalk->count; i++) {
        assert_true(stalk->parent[i] == i - 1);
    }
    assert_true(stalk->count > 3 && stalk->count <= 9);
    out_tree_free(stalk);
}

static float fork_residual(const OutTree *tree, float exponent)
{
    float most = 0.0f;
    for (int64_t i = 0; i < tree->count; i++) {
        float sum = 0.0f;
        for (int64_t k = i + 1; k < tree->count; k++) {
            sum += tree->parent[k] == i ? powf(tree->radius[k], exponent) : 0.0f;
        }
        most = sum > 0.0f ? fmaxf(most, fabsf(powf(sum, 1.0f / exponent) / tree->radius[i] - 1.0f))
                          : most;
    }
    return most;
}

static void radii_follow_their_rule(void **state)
{
    (void)state;
    static const char levels[] = "growth: {levels: [{attractors: 200}]}, radii: ";
    char keys[256];
    snprintf(keys, sizeof keys, "%s{model: pipe, exponent: 3, tip: 0.01}", levels);
    OutTree *tree = grow(keys);
    assert_true(fork_residual(tree, 3.0f) < 1e-4f);
    out_tree_free(tree);
    snprintf(keys, sizeof keys, "%s{model: even, tip: 0.01}", levels);
    tree = grow(keys);
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(tree->radius[i] == 0.01f);
    }
    out_tree_free(tree);
    snprintf(keys, sizeof keys, "%s{model: order, root: 0.08, tip: 0.01, ratio: 0.5}", levels);
    tree = grow(keys);
    for (int64_t i = 0; i < tree->count; i++) {
        float r = tree->radius[i];
        assert_true(r == 0.08f || r == 0.04f || r == 0.02f || r == 0.01f);
    }
    out_tree_free(tree);
    snprintf(keys, sizeof keys, "%s{model: birth, root: 0.08, tip: 0.01}", levels);
    tree = grow(keys);
    assert_float_equal(tree->radius[0], 0.08f, 1e-6);
    out_tree_free(tree);
    snprintf(keys, sizeof keys, "%s{model: murray, tip: 0.00001}", levels); // below 0.1 mm: 3
    tree = grow(keys);
    assert_true(fork_residual(tree, 3.0f) < 1e-3f);
    out_tree_free(tree);
}

// A further growth begins where the first ended, in the same envelope.
static void further_growth_continues_on_all_nodes(void **state)
{
    (void)state;
    OutTree *first = grow("points: {place: surface}, growth: {levels: [{attractors: 60}]}");
    OutTree *both =
        grow("points: {place: surface}, growth: {levels: [{attractors: 60}]}, further: "
             "[{growth: {rule: sectors, sector_axis: true, max_angle: 61, max_order: 1, "
             "levels: [{attractors: 1500, step: 0.5, kill: 0.9, influence: 5, relax: "
             "0}]}}]");
    assert_true(both->count > first->count + 300);
    for (int64_t i = 0; i < first->count; i++) {
        assert_true(first->parent[i] == both->parent[i]);
        assert_true(vec3_distance(first->position[i], both->position[i]) < 1e-6f);
        assert_true(both->birth[i] == first->birth[i]);
    }
    assert_true(both->birth[first->count] > out_tree_last_birth(first));
    out_tree_free(first);
    out_tree_free(both);
}

// Of every attractor at every step: it is there as long as no node is within the kill distance.
static void the_record_of_attractors_is_that_of_the_nodes(void **state)
{
    (void)state;
    OuttreeParams params = outtree_params_default();
    GrowLevel levels[2] = {
        {.attractors = 40, .step = 0.3f, .kill = 0.9f, .influence = 4.0f, .scale = 1.0f},
        {.attractors = 300, .step = 0.3f, .kill = 0.9f, .influence = 2.0f, .scale = 1.0f}};
    Run run = run_default();
    Recipe recipe = {.seed = 5, .label = "a", .run = &run};
    Grown whole = {0};
    Error e = {0};
    params.element.levels = levels; // without relaxation, which moves nodes after their level
    params.element.level_count = 2;
    assert_true(outtree_grow(&params, &recipe, &whole, &e));
    const AttractorLog *log = whole.state;
    const OutTree *tree = whole.tree;
    assert_int_equal(log->group_count, 2);
    assert_int_equal(log->count, 340);
    int64_t removed = 0, total = 0;
    for (int g = 0; g < 2; g++) {
        const AttractorGroup *group = &log->group[g];
        assert_int_equal(group->count, levels[g].attractors);
        for (int64_t i = group->first; i < group->first + group->count; i++, total++) {
            int32_t first = ATTRACTOR_LEFT;
            int32_t end = g == 0 ? log->group[1].born : ATTRACTOR_LEFT;
            for (int64_t n = 0; n < tree->count; n++) {
                int32_t birth = tree->birth[n] > group->born ? tree->birth[n] : group->born;
                bool near = vec3_distance(tree->position[n], log->position[i]) < group->kill;
                first = near && birth <= end && birth < first ? birth : first;
            }
            assert_int_equal(log->removed[i], first);
            removed += first != ATTRACTOR_LEFT;
        }
    }
    assert_true(removed > total / 2);
    AttractorLog then;
    assert_true(attractor_log_at(log, log->group[1].born - 1, &then, &e));
    assert_int_equal(then.group_count, 1);
    assert_true(then.count < levels[0].attractors);
    attractor_log_clear(&then);
    grown_clear(&whole);
}

static void errors_name_what_is_wrong(void **state)
{
    (void)state;
    expect_error("starts: {direction: [0, 0, 0]}", "starts.direction is zero");
    expect_error("placed: {points: [{position: [0, 0, 0], group: 2}]}", "group");
    expect_error("placed: {kill: 2, influence: 1}", "placed.kill is 2 m; it must be less");
    expect_error("points: {place: surface}, placed: {points: [{position: [0, 0, 0], group: 1}]}",
                 "has no envelope");
    expect_error("further: [{growth: {}}]", "growth.levels");
    expect_error("string: {axiom: X, rules: 'X -> ]['}", "rules");
    expect_error("growth: {rule: sectors, sector_angle: 1}", "sector_angle");
    expect_error("jitter: {hurst: 1}", "hurst");
    expect_error("show: {facing: [0, 0, 0]}", "facing is zero");
    Error e = {0};
    static const char tree[] =
        "objects:\n  - name: a\n    tree: {crown: {growth: {rule: string}}}\n";
    assert_null(scene_read_text(tree, strlen(tree), "s.yaml", "", NULL, 0, &e));
    assert_non_null(strstr(e.message, "only an outtree has an L-system"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(placed_points_are_starts_and_attractors),
        cmocka_unit_test(starts_lie_apart_on_the_surface),
        cmocka_unit_test(growth_stays_on_the_surface),
        cmocka_unit_test(distant_attractors_do_not_lead_off_the_surface),
        cmocka_unit_test(crystals_do_not_cross),
        cmocka_unit_test(growth_itself_can_be_seen),
        cmocka_unit_test(attractors_can_be_exported),
        cmocka_unit_test(tips_bear_lamps),
        cmocka_unit_test(every_rule_grows_and_threads_do_not_show),
        cmocka_unit_test(a_string_says_where_branches_go),
        cmocka_unit_test(radii_follow_their_rule),
        cmocka_unit_test(further_growth_continues_on_all_nodes),
        cmocka_unit_test(the_record_of_attractors_is_that_of_the_nodes),
        cmocka_unit_test(errors_name_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
