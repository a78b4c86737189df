// Skeletons from SWC files: placed, given a soma, skinned whole.
#include "making.h"
#include "testing.h"

#include "objects/skeleton/skeleton.h"
#include "outtree/measure.h"
#include "outtree/out_tree_io.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char FILE_NAME[] = "/tmp/ramify_test_skeleton.swc";
static const Run run = {.threads = 2};
static const Recipe recipe = {.seed = 1, .label = "object 'cell'", .run = &run};

static void write_text(const char *text)
{
    FILE *stream = fopen(FILE_NAME, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(text, 1, strlen(text), stream), strlen(text));
    fclose(stream);
}

static SkeletonParams params_of_file(void)
{
    static char name[sizeof FILE_NAME];
    SkeletonParams params = skeleton_params_default();
    memcpy(name, FILE_NAME, sizeof name);
    params.file = name;
    return params;
}

static OutTree *grow_text(const char *text, const SkeletonParams *params)
{
    Error e = {0};
    write_text(text);
    OutTree *tree = grow_kind(&kind_skeleton, params, &recipe, 1.0f, &e);
    unlink(FILE_NAME);
    if (!tree) {
        fail_msg("%s", e.message);
    }
    assert_true(out_tree_check(tree, NULL));
    return tree;
}

// In micrometres, with a soma of three points, an apical and two basal dendrites and an axon; line
// ends of DOS, a child before its parent.
static const char CELL[] = "# SCALE 1.0 1.0 1.0\r\n"
                           "1 1 100 200 300 6 -1\r\n"
                           "2 1 100 206 300 6 1\r\n"
                           "3 1 100 194 300 6 1\r\n"
                           "5 4 101 260 300 1.5 4\r\n"
                           "4 4 100 207 300 2 1\r\n"
                           "6 4 90 320 300 1 5\r\n"
                           "7 4 115 320 300 1 5\r\n"
                           "8 3 92 198 300 1 1\r\n"
                           "9 3 40 180 310 0.7 8\r\n"
                           "10 3 108 198 300 1 1\r\n"
                           "11 3 170 180 290 0.7 10\r\n"
                           "12 2 100 193 300 0.5 1\r\n"
                           "13 2 104 100 300 0.4 12\r\n"
                           "14 7 108 90 300 0 13\r\n";

static int64_t count_type(const OutTree *tree, int32_t type)
{
    int64_t count = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        count += tree->colony[i] == type;
    }
    return count;
}

static void is_scaled_turned_and_moved(void **state)
{
    (void)state;
    SkeletonParams params = params_of_file();
    params.scale = 1e-3f;
    params.origin = SKELETON_ROOT;
    params.position = vec3(1, 2, 3);
    params.rotation = vec3(0, 0, 90);
    params.radius_factor = 2.0f;
    params.soma = SKELETON_AS_IS;
    OutTree *tree = grow_text(CELL, &params);
    assert_int_equal(tree->count, 14);
    Vec3 p = tree->position[0];
    assert_true(p.x == 1.0f && p.y == 2.0f && p.z == 3.0f);
    // node 6: 10 um to the left of the root and 120 above it, turned to the left
    bool found = false;
    for (int64_t i = 0; i < tree->count; i++) {
        found = found || vec3_distance(tree->position[i], vec3(0.88f, 1.99f, 3.0f)) < 1e-5f;
    }
    assert_true(found);
    assert_true(fabsf(tree->radius[0] - 0.012f) < 1e-7f);
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(tree->radius[i] > 0.0f); // that of 0 too
    }
    out_tree_free(tree);
    params.origin = SKELETON_MIDDLE;
    tree = grow_text(CELL, &params);
    Aabb box = out_tree_bounds(tree);
    assert_true(vec3_distance(vec3_lerp(box.low, box.high, 0.5f), vec3(1, 2, 3)) < 1e-5f);
    out_tree_free(tree);
}

// Of the three ways to say a soma each becomes a ball of the radius it stands for, in one piece
// with all that leaves it.
static void every_kind_of_soma_becomes_a_ball(void **state)
{
    (void)state;
    static char outline[4096];
    int used = 0;
    for (int i = 0; i < 24; i++) { // points of an outline, thin, each from the one before
        double angle = 6.283185307 * i / 24.0;
        used += sprintf(outline + used, "%d 1 %g %g 0 0.1 %d\n", i + 1, 5.0 * cos(angle),
                        5.0 * sin(angle), i == 0 ? -1 : i);
    }
    sprintf(outline + used,
            "25 3 7 0 0 1 1\n26 3 30 0 0 1 25\n27 3 -7 0 0 1 12\n28 3 -30 0 0 1 27\n");
    const char *cells[] = {"1 1 0 0 0 5 -1\n2 3 7 0 0 1 1\n3 3 30 0 0 1 2\n4 3 -7 0 0 1 1\n"
                           "5 3 -30 0 0 1 4\n",
                           "1 1 0 0 0 5 -1\n2 1 0 5 0 5 1\n3 1 0 -5 0 5 1\n4 3 7 0 0 1 1\n"
                           "5 3 30 0 0 1 4\n6 3 -7 0 0 1 1\n7 3 -30 0 0 1 6\n",
                           outline};
    SkeletonParams params = params_of_file();
    for (int i = 0; i < 3; i++) {
        OutTree *tree = grow_text(cells[i], &params);
        float thickest = 0.0f;
        int64_t roots = 0;
        for (int64_t n = 0; n < tree->count; n++) {
            thickest = fmaxf(thickest, tree->radius[n]);
            roots += tree->parent[n] < 0;
        }
        assert_true(fabsf(thickest - 5.0f) < 0.2f);
        assert_int_equal(roots, 1);
        assert_int_equal(count_type(tree, SWC_BASAL), 4);
        Geometry geometry = {0};
        Error e = {0};
        const int material[] = {0, 0};
        Placing placing = {.recipe = &recipe, .geometry = &geometry, .material = material};
        Grown grown = grown_of(tree);
        assert_true(skeleton_geometry(&params, &grown, &placing, &e));
        assert_int_equal(geometry.count, 1);
        MeshTopology topology;
        assert_true(mesh_topology(geometry.part[0].mesh, &topology, &e));
        assert_int_equal(topology.open_edges + topology.overused_edges + topology.misoriented_edges,
                         0);
        assert_int_equal(topology.component_count, 1);
        Aabb box = mesh_bounds(geometry.part[0].mesh);
        assert_true(box.high.y > 4.0f && box.high.y < 6.0f && box.low.y < -4.0f);
        assert_true(box.high.x > 29.0f && box.low.x < -29.0f);
        geometry_clear(&geometry);
        out_tree_free(tree);
    }
}

static void types_are_picked(void **state)
{
    (void)state;
    SkeletonParams params = params_of_file();
    params.axon = false;
    params.apical = false;
    params.soma = SKELETON_NO_SOMA;
    OutTree *tree = grow_text(CELL, &params);
    assert_int_equal(tree->count, 5); // basal dendrites, and what grew from the axon's end
    assert_int_equal(count_type(tree, SWC_BASAL), 4);
    assert_int_equal(count_type(tree, 7), 1);
    int64_t roots = 0;
    for (int64_t i = 0; i < tree->count; i++) {
        roots += tree->parent[i] < 0;
    }
    assert_int_equal(roots, 3);
    out_tree_free(tree);
    params.basal = params.rest = false;
    write_text(CELL);
    Error e = {0};
    assert_null(grow_kind(&kind_skeleton, &params, &recipe, 1.0f, &e));
    unlink(FILE_NAME);
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "all nodes of '"));
}

// An axon of another material is a mesh of its own that begins inside of the soma.
static void axon_stands_apart(void **state)
{
    (void)state;
    SkeletonParams params = params_of_file();
    OutTree *tree = grow_text(CELL, &params);
    Geometry geometry = {0};
    Placing placing = placing_in(&geometry, &recipe);
    placing.material += 3; // from 3 on
    Grown grown = grown_of(tree);
    assert_true(skeleton_geometry(&params, &grown, &placing, NULL));
    assert_int_equal(geometry.count, 2);
    assert_int_equal(geometry.part[0].material, 3);
    assert_int_equal(geometry.part[1].material, 4);
    Aabb body = mesh_bounds(geometry.part[0].mesh), axon = mesh_bounds(geometry.part[1].mesh);
    assert_true(body.high.y > 319.0f && body.low.y > 175.0f);
    assert_true(axon.low.y < 91.0f && axon.high.y > 194.0f && axon.high.y < 207.0f);
    geometry_clear(&geometry);
    out_tree_free(tree);
}

// At a share of its growth it is a part of what it becomes.
static void grows_by_births(void **state)
{
    (void)state;
    SkeletonParams params = params_of_file();
    OutTree *whole = grow_text(CELL, &params);
    write_text(CELL);
    OutTree *tree = grow_kind(&kind_skeleton, &params, &recipe, 0.5f, NULL);
    unlink(FILE_NAME);
    assert_non_null(tree);
    assert_true(tree->count < whole->count && tree->count > 9);
    assert_true(out_tree_last_birth(tree) <= (out_tree_last_birth(whole) + 1) / 2);
    for (int64_t i = 0; i < tree->count; i++) {
        bool there = false;
        for (int64_t k = 0; !there && k < whole->count; k++) {
            there = tree->id[i] == whole->id[k] && tree->radius[i] <= whole->radius[k] &&
                    vec3_distance(tree->position[i], whole->position[k]) == 0.0f;
        }
        assert_true(there);
    }
    out_tree_free(tree);
    out_tree_free(whole);
}

static void types_survive_writing(void **state)
{
    (void)state;
    SkeletonParams params = params_of_file();
    OutTree *tree = grow_text(CELL, &params);
    assert_true(out_tree_write_swc(tree, FILE_NAME, NULL));
    OutTree *back = out_tree_read_swc(FILE_NAME, NULL);
    unlink(FILE_NAME);
    assert_non_null(back);
    assert_int_equal(back->count, tree->count);
    assert_memory_equal(back->colony, tree->colony, (size_t)tree->count * sizeof(int32_t));
    assert_memory_equal(back->position, tree->position, (size_t)tree->count * sizeof(Vec3));
    assert_memory_equal(back->radius, tree->radius, (size_t)tree->count * sizeof(float));
    out_tree_free(tree);
    out_tree_free(back);
}

static void refuses(const char *text, const char *words)
{
    SkeletonParams params = params_of_file();
    Error e = {0};
    write_text(text);
    assert_null(grow_kind(&kind_skeleton, &params, &recipe, 1.0f, &e));
    unlink(FILE_NAME);
    assert_int_equal(e.code, ERROR_INPUT);
    if (!strstr(e.message, words)) {
        fail_msg("no '%s' in '%s'", words, e.message);
    }
}

static void says_what_is_wrong_with_a_file(void **state)
{
    (void)state;
    refuses("1 1 0 0 0 1 -1\n2 3 0 1 0 1 7\n", "parent 7 is no node");
    refuses("1 1 0 0 0 1 2\n2 3 0 1 0 1 1\n", "its own ancestor");
    refuses("1 1 0 0 0 1 -1\n2 3 0 3e38 0 1 1\n", "scale");
    refuses("", "no node in it");
    SkeletonParams params = params_of_file(); // which is not there any more
    Error e = {0};
    assert_null(grow_kind(&kind_skeleton, &params, &recipe, 1.0f, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.file, FILE_NAME);
}

// One node, nodes in one place, radii of nothing, a hundred thousand somas: a mesh or nothing, but
// no crash.
static void survives_odd_skeletons(void **state)
{
    (void)state;
    enum { SOMAS = 100000 };
    char *many = malloc((size_t)SOMAS * 80), *at = many;
    assert_non_null(many);
    for (int i = 0; i < SOMAS; i++) {
        at += sprintf(at, "%d 1 %d 0 0 0 -1\n%d 3 %d 1 0 0 %d\n", 2 * i, i, 2 * i + 1, i, 2 * i);
    }
    SkeletonParams params = params_of_file();
    OutTree *tree = grow_text(many, &params);
    assert_int_equal(count_type(tree, SWC_BASAL), SOMAS);
    out_tree_free(tree);
    free(many);
    const char *odd[] = {"1 1 0 0 0 0 -1\n", "1 1 5 5 5 3 -1\n",
                         "1 1 0 0 0 1 -1\n2 1 0 0 0 1 1\n3 3 0 0 0 1 2\n4 3 0 0 0 1 3\n",
                         "1 3 0 0 0 0 -1\n2 3 0 0 0 0 1\n"};
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        tree = grow_text(odd[i], &params);
        Geometry geometry = {0};
        const int material[] = {0, 0};
        Placing placing = {.recipe = &recipe, .geometry = &geometry, .material = material};
        Grown grown = grown_of(tree);
        assert_true(skeleton_geometry(&params, &grown, &placing, NULL));
        geometry_clear(&geometry);
        out_tree_free(tree);
    }
}

// A straight dendrite of 400 and a soma of 5: 2 spines per unit beyond 12.5, in whole numbers per
// edge; each is five nodes, its foot inside the dendrite, its end at most 1.4 lengths outside.
static void spines_have_their_density_and_length(void **state)
{
    (void)state;
    char text[4096];
    int at = snprintf(text, sizeof text, "1 1 0 0 0 5 -1\n");
    for (int i = 0; i < 100; i++) {
        at += snprintf(text + at, sizeof text - (size_t)at, "%d 3 0 %d 0 1 %d\n", i + 2,
                       4 * (i + 1), i + 1);
    }
    SkeletonParams params = params_of_file();
    OutTree *tree = grow_text(text, &params);
    int64_t before = tree->count;
    assert_true(skeleton_dress(tree, &params, &recipe, NULL));
    assert_int_equal(tree->count, before); // none are asked for
    params.spines = 2.0f;
    params.flare = 1.0f;
    assert_true(skeleton_dress(tree, &params, &recipe, NULL));
    assert_true(out_tree_check(tree, NULL));
    int64_t spines = (tree->count - before) / 5;
    assert_int_equal((tree->count - before) % 5, 0);
    assert_in_range(spines, 768, 784); // 2 x 387.5, up to an edge
    for (int64_t i = before; i < tree->count; i++) {
        Vec3 p = tree->position[i];
        float off = sqrtf(p.x * p.x + p.z * p.z);
        assert_true((i - before) % 5 > 0 || off < 1.1f);
        assert_true(off < 1.1f + 1.4f * params.spine_length);
        assert_true((i - before) % 5 < 4 || off > 1.1f);
    }
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_scaled_turned_and_moved),
        cmocka_unit_test(every_kind_of_soma_becomes_a_ball),
        cmocka_unit_test(types_are_picked),
        cmocka_unit_test(axon_stands_apart),
        cmocka_unit_test(grows_by_births),
        cmocka_unit_test(types_survive_writing),
        cmocka_unit_test(says_what_is_wrong_with_a_file),
        cmocka_unit_test(spines_have_their_density_and_length),
        cmocka_unit_test(survives_odd_skeletons),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
