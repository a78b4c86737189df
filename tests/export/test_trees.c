// Out-trees and heights as files: which files, and the same bits in them.
#include "testing.h"

#include "export/formats.h"
#include "export/heights.h"
#include "land/height_measure.h"
#include "outtree/out_tree_io.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/ramify_trees_XXXXXX";

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir("/") == 0 && system(command) == 0 ? 0 : -1;
}

static OutTree *make_tree(int count, float scale)
{
    OutTree *tree = out_tree_new(NULL);
    for (int i = 0; i < count; i++) {
        Vec3 p = vec3(scale / (float)(i + 3), (float)i, -1e-7f * (float)i);
        out_tree_add_node(tree, p, i % 50 == 0 ? -1 : i - 1 - i % 3 * (i % 50 > 3), i, i % 2,
                          (uint64_t)i, NULL);
        tree->radius[i] = scale / (float)(7 + i);
    }
    assert_true(out_tree_check(tree, NULL));
    return tree;
}

static bool write_trees(const OutTree *const *tree, const char *file, Error *e)
{
    const char *const names[] = {"oak", "stone", "elm & <ash>"};
    const ExportSource source = {
        .title = "scene", .object_count = 3, .object_name = names, .tree = tree};
    Run run = run_default();
    return export_format(file)->write(&source, file, &run, e);
}

static void assert_same_skeleton(const OutTree *tree, const char *file)
{
    Error e = {0};
    OutTree *back = out_tree_read_swc(file, &e);
    assert_non_null(back);
    assert_int_equal(back->count, tree->count);
    size_t count = (size_t)tree->count;
    assert_memory_equal(back->position, tree->position, count * sizeof(Vec3));
    assert_memory_equal(back->radius, tree->radius, count * sizeof(float));
    assert_memory_equal(back->parent, tree->parent, count * sizeof *tree->parent);
    out_tree_free(back);
}

static void swc_reads_back_to_the_same_bits(void **state)
{
    (void)state;
    Error e = {0};
    OutTree *oak = make_tree(400, 1.0f), *elm = make_tree(90, 33.3f);
    const OutTree *const one[3] = {oak, NULL, NULL}, *const two[3] = {oak, NULL, elm};
    assert_true(write_trees(one, "one.swc", &e));
    assert_same_skeleton(oak, "one.swc");
    assert_true(write_trees(two, "two.swc", &e));
    assert_int_not_equal(access("two.swc", F_OK), 0);
    assert_same_skeleton(oak, "two-oak.swc");
    assert_same_skeleton(elm, "two-elm & <ash>.swc");
    out_tree_free(oak);
    out_tree_free(elm);
}

static void a_scene_without_trees_is_an_error(void **state)
{
    (void)state;
    const OutTree *const none[3] = {NULL, NULL, NULL};
    const char *const files[] = {"none.swc", "none.json", "none.graphml"};
    for (int i = 0; i < 3; i++) {
        Error e = {0};
        assert_false(write_trees(none, files[i], &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_int_not_equal(access(files[i], F_OK), 0);
    }
}

static HeightField *make_land(Vec2 cell)
{
    HeightField *field = height_field_new(7, 5, cell, (Vec2){-30.0f, 11.5f}, NULL);
    assert_non_null(field);
    for (int i = 0; i < 35; i++) {
        field->height[i] = 1000.0f / (float)(i - 17) * (i == 17 ? 0.0f : 1.0f);
    }
    field->height[17] = NAN;
    return field;
}

static void esri_grids_read_back_to_the_same_bits(void **state)
{
    (void)state;
    Run run = run_default();
    const Vec2 cells[] = {{2.5f, 2.5f}, {2.0f, 0.3f}};
    for (int k = 0; k < 2; k++) {
        Error e = {0};
        HeightField *field = make_land(cells[k]);
        assert_true(export_height_field(field, "land.asc", &run, &e));
        HeightField *back = height_field_read_asc("land.asc", &e);
        assert_non_null(back);
        assert_int_equal(back->columns, 7);
        assert_int_equal(back->rows, 5);
        assert_true(back->cell.x == cells[k].x && back->cell.y == cells[k].y);
        for (int i = 0; i < 35; i++) {
            assert_true(i == 17 ? isnan(back->height[i]) : back->height[i] == field->height[i]);
        }
        height_field_free(back);
        height_field_free(field);
    }
}

// Samples stand in the middle of cells; north is -z.
static void esri_grids_lie_where_the_land_lies(void **state)
{
    (void)state;
    Run run = run_default();
    HeightField *field = make_land((Vec2){2.5f, 2.5f});
    assert_true(export_height_field(field, "place.asc", &run, NULL));
    FILE *stream = fopen("place.asc", "r");
    assert_non_null(stream);
    double x, y;
    assert_int_equal(fscanf(stream, "ncols 7 nrows 5 xllcorner %lf yllcorner %lf", &x, &y), 2);
    fclose(stream);
    assert_true(x == -30.0 - 1.25);
    assert_true(y == -(11.5 + 4 * 2.5) - 1.25);
    height_field_free(field);
}

static void other_endings_are_refused(void **state)
{
    (void)state;
    Run run = run_default();
    Error e = {0};
    HeightField *field = make_land((Vec2){1, 1});
    assert_false(export_height_field(field, "land.obj", &run, &e));
    assert_int_equal(e.code, ERROR_INPUT);
    height_field_free(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(swc_reads_back_to_the_same_bits),
        cmocka_unit_test(a_scene_without_trees_is_an_error),
        cmocka_unit_test(esri_grids_read_back_to_the_same_bits),
        cmocka_unit_test(esri_grids_lie_where_the_land_lies),
        cmocka_unit_test(other_endings_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
