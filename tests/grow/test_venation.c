// Leaf veins: relative neighbours against their definition, open veins a tree that comes to every
// source, closed ones with loops.
#include "testing.h"

#include "base/random.h"
#include "grow/venation/veinlets.h"
#include "outtree/join.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static Vec3 random_point(uint64_t key)
{
    return vec3(random_unit(random_key(key, 0)), random_unit(random_key(key, 1)), 0);
}

static int compare_indices(const void *a, const void *b)
{
    return *(const int32_t *)a - *(const int32_t *)b;
}

// v is a relative neighbour of p unless some u is nearer than |v - p| to both (Toussaint 1980).
static void neighbours_follow_the_definition(void **state)
{
    (void)state;
    enum { NODES = 80, TRIALS = 400 };
    Aabb box = {vec3(0, 0, 0), vec3(1, 1, 0)};
    VeinGrid grid = {0};
    int total = 0;
    for (int trial = 0; trial < TRIALS; trial++) {
        Vec3 node[NODES];
        int count = 3 + trial % (NODES - 2);
        for (int i = 0; i < count; i++) {
            node[i] = random_point(random_key((uint64_t)trial, (uint64_t)i));
        }
        Vec3 p = random_point(random_key((uint64_t)trial, 1000));
        float reach = trial % 3 == 0 ? 0.3f : 2.0f;
        assert_true(vein_grid_fill(&grid, node, count, box, 0.07f + 0.001f * (float)trial, NULL));
        int32_t found[VEIN_MAX_NEIGHBOURS], wanted[NODES], nearest = -1;
        int found_count = vein_relative_neighbours(&grid, node, p, reach, found);
        int wanted_count = 0;
        for (int v = 0; v < count; v++) {
            float d = vec3_distance(node[v], p);
            bool is_one = d < reach;
            for (int u = 0; is_one && u < count; u++) {
                is_one = u == v ||
                         !(vec3_distance(node[u], p) < d && vec3_distance(node[u], node[v]) < d);
            }
            if (is_one) {
                wanted[wanted_count++] = v;
            }
            if (d < reach && (nearest < 0 || d < vec3_distance(node[nearest], p))) {
                nearest = v;
            }
        }
        qsort(found, (size_t)found_count, sizeof *found, compare_indices);
        assert_int_equal(found_count, wanted_count);
        assert_memory_equal(found, wanted, sizeof *found * (size_t)found_count);
        assert_int_equal(vein_nearest(&grid, node, p, reach), nearest);
        total += found_count;
    }
    assert_true(total > 2 * TRIALS); // between 2 and 3 on average
    vein_grid_free(&grid);
}

static OutTree *grow(const VeinParams *params, PointSet *sources, VeinReport *report)
{
    Error e = {0};
    Run run = run_default();
    OutTree *tree = veins_grow(params, sources, report, &run, &e);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, &e));
    return tree;
}

static int64_t count_closings(const OutTree *tree)
{
    int64_t same = 0; // tips at the place of an earlier node
    for (int64_t i = 0; i < tree->count; i++) {
        for (int64_t j = 0; j < i; j++) {
            if (memcmp(&tree->position[i], &tree->position[j], sizeof(Vec3)) == 0) {
                same++;
                break;
            }
        }
    }
    return same;
}

static void open_veins_come_to_every_source(void **state)
{
    (void)state;
    VeinParams params = vein_params_default();
    params.marginal = true; // where nothing moves, distances stay those of the time
    params.birth = 0.003f, params.kill = 0.0012f, params.step = 0.0006f;
    params.slant = 0.0f;
    PointSet *sources = points_new(NULL);
    VeinReport report;
    OutTree *tree = grow(&params, sources, &report);
    assert_int_equal(report.sources, sources->count);
    assert_true(report.sources > 100);
    assert_int_equal(report.loops, 0);
    assert_int_equal(count_closings(tree), 0);
    int64_t far = 0;
    for (int64_t i = 0; i < sources->count; i++) {
        float nearest = INFINITY;
        for (int64_t n = 0; n < tree->count; n++) {
            nearest = fminf(nearest, vec3_distance(tree->position[n], sources->position[i]));
        }
        far += nearest > params.kill;
        for (int64_t j = 0; j < i; j++) { // those alive at a time keep apart; so do all here
            assert_true(vec3_distance(sources->position[i], sources->position[j]) > params.kill);
        }
    }
    assert_int_equal(far, report.sources_left);
    assert_true(far <= report.sources / 50); // two sources that pull a tip both ways hold it
    int64_t roots = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        roots += tree->parent[i] < 0;
        assert_true(i == 0 || tree->position[i].y == 0.0f ||
                    leaf_contains(&params.outline, 1.02f, tree->position[i]));
    }
    assert_int_equal(roots, 1);
    points_free(sources);
    out_tree_free(tree);
}

static void closed_veins_have_loops(void **state)
{
    (void)state;
    VeinParams params = vein_params_default();
    params.closed = true;
    params.birth = 0.003f, params.kill = 0.0015f, params.step = 0.0007f;
    VeinReport report;
    OutTree *tree = grow(&params, NULL, &report);
    assert_true(report.loops > 30);
    assert_int_equal(count_closings(tree), report.loops);
    int64_t pieces, loops;
    assert_true(out_tree_count_pieces(tree, &pieces, &loops, NULL));
    assert_int_equal(pieces, 1);
    assert_int_equal(loops, report.loops);
    OutTree *again = grow(&params, NULL, &report);
    assert_true(out_tree_hash(tree) == out_tree_hash(again));
    out_tree_free(tree);
    out_tree_free(again);
}

// Planted secondary veins arch to one another: a loop for each but the last of a side, whatever
// grows between them later; with the blade too small for sources they are all there is.
static void secondary_veins_arch_to_one_another(void **state)
{
    (void)state;
    enum { SECONDARIES = 7 };
    VeinParams params = vein_params_default();
    params.birth = 0.2f, params.kill = 0.1f, params.step = 0.0007f;
    params.secondaries = SECONDARIES;
    VeinReport report;
    OutTree *tree = grow(&params, NULL, &report);
    int64_t pieces, loops;
    assert_true(out_tree_count_pieces(tree, &pieces, &loops, NULL));
    assert_int_equal(pieces, 1);
    assert_int_equal(loops, 2 * (SECONDARIES - 1));
    assert_int_equal(report.loops, loops);
    assert_int_equal(count_closings(tree), loops);
    int64_t right = 0, left = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        float half = leaf_half_width(&params.outline, p.y);
        assert_true(p.y == 0.0f || fabsf(p.x) < 0.95f * half);
        assert_true(p.x == 0.0f || p.y > tree->position[tree->parent[i]].y - 0.002f); // upward
        bool leaves = p.x != 0.0f && tree->position[tree->parent[i]].x == 0.0f;
        right += leaves && p.x > 0.0f, left += leaves && p.x < 0.0f;
    }
    assert_int_equal(right, SECONDARIES);
    assert_int_equal(left, SECONDARIES);
    out_tree_free(tree);
}

// Every tertiary vein leaves a secondary one and ends, in a loop, on the next toward the tip, at a
// wide angle; without any the secondary veins are as they were.
static void tertiary_veins_cross_between_secondary_veins(void **state)
{
    (void)state;
    enum { SECONDARIES = 6, TERTIARIES = 5, RUNGS = 2 * (SECONDARIES - 1) * TERTIARIES };
    VeinParams params = vein_params_default();
    params.birth = 0.2f, params.kill = 0.1f, params.step = 0.0007f;
    params.secondaries = SECONDARIES;
    OutTree *plain = grow(&params, NULL, NULL);
    params.tertiaries = TERTIARIES;
    VeinReport report;
    OutTree *tree = grow(&params, NULL, &report);
    int64_t pieces, loops, rungs = 0;
    float along = 0.0f; // cosines to the course of the secondary veins
    assert_true(out_tree_count_pieces(tree, &pieces, &loops, NULL));
    assert_int_equal(pieces, 1);
    assert_int_equal(loops, 2 * (SECONDARIES - 1) + RUNGS);
    assert_int_equal(report.loops, loops);
    assert_int_equal(count_closings(tree), loops);
    bool *planted = calloc((size_t)tree->count, sizeof *planted); // also without tertiaries
    for (int64_t i = 0, known = 0; i < tree->count; i++) {
        planted[i] = known < plain->count &&
                     vec3_distance(tree->position[i], plain->position[known]) == 0.0f;
        known += planted[i];
    }
    for (int64_t i = 1; i < tree->count; i++) {
        int32_t from = tree->parent[i];
        if (!planted[i] && planted[from]) {
            Vec3 way = vec3_normalize(vec3_sub(tree->position[i], tree->position[from]));
            Vec3 course =
                vec3_normalize(vec3_sub(tree->position[from], tree->position[tree->parent[from]]));
            assert_true(tree->position[from].x != 0.0f); // not on the midrib
            along += fabsf(vec3_dot(way, course));
            rungs++;
        }
    }
    assert_int_equal(rungs, RUNGS);
    assert_true(along < 0.65f * RUNGS); // they cross, at 50 degrees and more in the mean
    free(planted);
    out_tree_free(plain);
    out_tree_free(tree);
}

// A vein ends near the point of every tooth but perhaps the least, and none leaves the margin.
static void veins_lead_to_the_points_of_teeth(void **state)
{
    (void)state;
    VeinParams params = vein_params_default();
    params.closed = true;
    params.birth = 0.002f, params.kill = 0.001f, params.step = 0.0005f;
    params.outline.teeth = 16;
    params.outline.uneven = 0.5f;
    VeinReport report;
    OutTree *tree = grow(&params, NULL, &report);
    int reached = 0;
    for (int i = 0; i < 32; i++) {
        Vec3 p = leaf_tooth(&params.outline, i % 2 ? 1.0f : -1.0f, i / 2);
        float nearest = INFINITY;
        for (int64_t n = 0; n < tree->count; n++) {
            nearest = fminf(nearest, vec3_distance(tree->position[n], p));
        }
        reached += nearest < 1.6f * params.kill;
    }
    assert_in_range(reached, 28, 32);
    for (int64_t n = 1; n < tree->count; n++) {
        assert_true(leaf_contains(&params.outline, 1.001f, tree->position[n]));
    }
    out_tree_free(tree);
}

static void a_larger_leaf_has_the_same_veins(void **state)
{
    (void)state;
    VeinParams params = vein_params_default();
    params.closed = true;
    params.birth = 0.004f, params.kill = 0.002f, params.step = 0.001f;
    VeinReport report;
    OutTree *small = grow(&params, NULL, &report);
    params.outline.length *= 8.0f, params.outline.width *= 8.0f;
    params.birth *= 8.0f, params.kill *= 8.0f, params.step *= 8.0f;
    OutTree *large = grow(&params, NULL, &report);
    assert_int_equal(small->count, large->count);
    assert_memory_equal(small->parent, large->parent, sizeof(int32_t) * (size_t)small->count);
    out_tree_free(small);
    out_tree_free(large);
}

static void bad_numbers_are_named(void **state)
{
    (void)state;
    VeinParams params = vein_params_default();
    params.kill = params.birth;
    Error e = {0};
    Run run = run_default();
    assert_null(veins_grow(&params, NULL, NULL, &run, &e));
    assert_non_null(strstr(e.message, "kill must be below birth"));
}

// Length of the free ends: from each tip that lies on no other node back to the fork it left.
static int count_free_ends(const OutTree *tree, float *shortest)
{
    int count = 0;
    *shortest = INFINITY;
    int *children = calloc((size_t)tree->count, sizeof *children);
    assert_non_null(children);
    for (int64_t i = 1; i < tree->count; i++) {
        children[tree->parent[i]]++;
    }
    for (int64_t i = 0; i < tree->count; i++) {
        bool joined = false;
        for (int64_t k = 0; k < tree->count && children[i] == 0; k++) {
            joined =
                joined || (k != i && vec3_distance(tree->position[i], tree->position[k]) == 0.0f);
        }
        if (children[i] > 0 || joined) {
            continue;
        }
        float way = 0.0f;
        for (int64_t k = i; tree->parent[k] >= 0 && (k == i || children[k] == 1);
             k = tree->parent[k]) {
            way += vec3_distance(tree->position[k], tree->position[tree->parent[k]]);
        }
        *shortest = fminf(*shortest, way);
        count++;
    }
    free(children);
    return count;
}

// Trimming leaves no short free ends and closes or opens no loop; veinlets end freely in the
// areoles, away from the net, and open no loop either.
static void veinlets_end_in_areoles(void **state)
{
    (void)state;
    VeinParams params = vein_params_default();
    params.closed = true;
    params.birth = 0.004f, params.kill = 0.002f, params.step = 0.001f;
    Run run = run_default();
    OutTree *tree = veins_grow(&params, NULL, NULL, &run, NULL);
    assert_non_null(tree);
    int64_t pieces, loops, before;
    float shortest;
    assert_true(out_tree_count_pieces(tree, &pieces, &before, NULL));
    assert_true(veins_trim(tree, 1.2f * params.birth, NULL));
    int kept = count_free_ends(tree, &shortest);
    assert_true(kept == 0 || shortest >= 1.2f * params.birth);
    assert_true(out_tree_count_pieces(tree, &pieces, &loops, NULL));
    assert_int_equal(pieces, 1);
    assert_int_equal(loops, before);

    int64_t net = tree->count;
    assert_true(veins_add_veinlets(tree, &params, 1.0f, &run, NULL));
    assert_true(out_tree_check(tree, NULL));
    assert_true(out_tree_count_pieces(tree, &pieces, &loops, NULL));
    assert_int_equal(pieces, 1);
    assert_int_equal(loops, before);
    assert_true(count_free_ends(tree, &shortest) > kept + (int)loops / 4);
    for (int64_t i = net; i < tree->count; i++) {
        bool first = tree->parent[i] < net; // near the vein that it leaves
        for (int64_t k = 0; k < net && !first; k++) {
            assert_true(vec3_distance(tree->position[i], tree->position[k]) > 0.36f * params.birth);
        }
    }
    OutTree *none = out_tree_copy(tree, NULL);
    assert_true(veins_add_veinlets(none, &params, 0.0f, &run, NULL));
    assert_int_equal(none->count, tree->count);
    out_tree_free(none);
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_follow_the_definition),
        cmocka_unit_test(open_veins_come_to_every_source),
        cmocka_unit_test(closed_veins_have_loops),
        cmocka_unit_test(secondary_veins_arch_to_one_another),
        cmocka_unit_test(tertiary_veins_cross_between_secondary_veins),
        cmocka_unit_test(veins_lead_to_the_points_of_teeth),
        cmocka_unit_test(a_larger_leaf_has_the_same_veins),
        cmocka_unit_test(veinlets_end_in_areoles),
        cmocka_unit_test(bad_numbers_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
