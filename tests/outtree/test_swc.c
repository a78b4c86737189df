// Reading SWC: what programs write, and what nobody should.
#include "outtree/out_tree_io.h"
#include "testing.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char FILE_NAME[] = "/tmp/ramify_test_swc.swc";

static OutTree *read_bytes(const char *bytes, size_t length, Error *e)
{
    FILE *stream = fopen(FILE_NAME, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, length, stream), length);
    fclose(stream);
    *e = (Error){0};
    OutTree *tree = out_tree_read_swc(FILE_NAME, e);
    unlink(FILE_NAME);
    return tree;
}

static OutTree *read_text(const char *text, Error *e)
{
    return read_bytes(text, strlen(text), e);
}

static void what_was_written_reads_back_the_same(void **state)
{
    (void)state;
    OutTree *tree = out_tree_new(NULL);
    for (int i = 0; i < 300; i++) {
        int64_t parent = i % 100 == 0 ? -1 : i - 1 - i % 7 % (i % 100);
        out_tree_add_node(tree, vec3(1.0f / (float)(i + 1), (float)i * 1e-9f, -(float)i), parent, i,
                          0, (uint64_t)i, NULL);
        tree->radius[i] = 0.1f / (float)(i + 3);
    }
    Error e = {0};
    assert_true(out_tree_write_swc(tree, FILE_NAME, &e));
    OutTree *back = out_tree_read_swc(FILE_NAME, &e);
    unlink(FILE_NAME);
    assert_non_null(back);
    assert_true(out_tree_check(back, NULL));
    assert_int_equal(back->count, tree->count);
    for (int i = 0; i < 300; i++) {
        assert_memory_equal(&back->position[i], &tree->position[i], sizeof(Vec3));
        assert_true(back->radius[i] == tree->radius[i] && back->parent[i] == tree->parent[i]);
    }
    out_tree_free(tree);
    out_tree_free(back);
}

static void any_order_comments_and_line_ends_are_read(void **state)
{
    (void)state;
    Error e;
    OutTree *tree = read_text("# from elsewhere\r\n\r\n"
                              "  30 3 0 2 0 0.1 20\r\n"
                              "20\t3 0 1 0 0.2 10  \r\n"
                              "\t# inside\n"
                              "10 1 0 0 0 0.3 -1\n"
                              "40 2 1e-3 -2.5 +3 0 20",
                              &e);
    assert_non_null(tree);
    assert_true(out_tree_check(tree, NULL));
    assert_int_equal(tree->count, 4);
    static const float y[4] = {0, 1, 2, -2.5f};
    static const int32_t parent[4] = {-1, 0, 1, 1}, colony[4] = {1, 3, 3, 2};
    for (int i = 0; i < 4; i++) {
        assert_true(tree->position[i].y == y[i]);
        assert_int_equal(tree->parent[i], parent[i]);
        assert_int_equal(tree->colony[i], colony[i]);
    }
    assert_int_equal(tree->birth[3], 2);
    out_tree_free(tree);
}

static OutTree *read_sample(const char *name, int64_t count)
{
    char file[128];
    Error e = {0};
    snprintf(file, sizeof file, "tests/outtree/data/%s", name);
    OutTree *tree = out_tree_read_swc(file, &e);
    if (!tree) {
        fail_msg("%s:%d: %s", file, e.line, e.message);
    }
    assert_true(out_tree_check(tree, NULL));
    assert_int_equal(tree->count, count);
    return tree;
}

// A header, all types of a neuron, CRLF, tabs, columns set with blanks, coordinates in micrometres.
static void files_of_neurons_are_read(void **state)
{
    (void)state;
    OutTree *tree = read_sample("header_types_crlf.swc", 11);
    static const int32_t type[11] = {1, 1, 1, 3, 3, 4, 4, 2, 5, 6, 7};
    static const int32_t parent[11] = {-1, 0, 0, 0, 3, 2, 5, 1, 4, 4, 6};
    for (int i = 0; i < 11; i++) {
        assert_int_equal(tree->colony[i], type[i]);
        assert_int_equal(tree->parent[i], parent[i]);
    }
    assert_true(tree->radius[0] == 6.25f && tree->radius[8] == 0.5f);
    assert_true(tree->position[6].y == 25.5f && tree->position[9].z == 1.0f);
    out_tree_free(tree);
}

static void children_may_come_before_their_parents(void **state)
{
    (void)state;
    OutTree *tree = read_sample("backwards.swc", 6);
    static const float x[6] = {0, 0, 0, 0, 5, 5}, y[6] = {0, 1, 2, 3, 0, 1};
    static const int32_t parent[6] = {-1, 0, 1, 2, -1, 4};
    for (int i = 0; i < 6; i++) {
        assert_true(tree->position[i].x == x[i] && tree->position[i].y == y[i]);
        assert_int_equal(tree->parent[i], parent[i]);
    }
    assert_true(tree->radius[0] == 0.4f && tree->radius[5] == 0.1f);
    out_tree_free(tree);
}

static void numbers_may_look_as_programs_print_them(void **state)
{
    (void)state;
    OutTree *tree = read_sample("numbers.swc", 2);
    assert_true(tree->position[0].x == 1.0f && tree->position[0].y == -0.25f);
    assert_true(tree->position[0].z == 0.125f && tree->radius[0] == 1.0f);
    assert_int_equal(tree->parent[1], 0);
    assert_int_equal(tree->colony[1], 3);
    out_tree_free(tree);
}

static void wrong_files_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
        int line;
    } wrong[] = {
        {"", "no node in it", 0},
        {"# only this\n", "no node in it", 0},
        {"1 0 0 0 0 1 -1\n2 0 0 0 0 1\n", "only 6 numbers", 2},
        {"1 0 0 0 0 1 -1 9\n", "'9' after seven numbers", 1},
        {"1 0 0 zero 0 1 -1\n", "'zero 0 1 -1' is no number", 1},
        {"1 0 0 0x 0 1 -1\n", "is no number", 1},
        {"1 0 0 0 0 1 -1\n1 0 0 0 0 1 -1\n", "number 1 is already used in line 1", 2},
        {"1 0 0 0 0 1 2\n", "parent 2 is no node", 1},
        {"1 0 0 0 0 1 1\n", "node 1 is its own ancestor", 1},
        {"1 0 0 0 0 1 -1\n2 0 0 0 0 1 3\n3 0 0 0 0 1 2\n", "node 2 is its own ancestor", 2},
        {"5 0 0 0 0 1 -2\n", "number 5 with parent -2", 1},
        {"1.5 0 0 0 0 1 -1\n", "number 1.5", 1},
        {"1e300 0 0 0 0 1 -1\n", "number 1e+300", 1},
        {"1 0.5 0 0 0 1 -1\n", "type 0.5", 1},
        {"1 nan 0 0 0 1 -1\n", "type nan", 1},
        {"1 0 nan 0 0 1 -1\n", "nan is too large", 1},
        {"1 0 0 1e39 0 1 -1\n", "1e+39 is too large", 1},
        {"1 0 0 0 0 -1 -1\n", "radius -1", 1},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        Error e;
        assert_null(read_text(wrong[i].text, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_int_equal(e.line, wrong[i].line);
        assert_string_equal(e.file, FILE_NAME);
        if (!strstr(e.message, wrong[i].says)) {
            fail_msg("'%s' does not say '%s'", e.message, wrong[i].says);
        }
    }
}

static void bytes_that_are_no_text_are_refused(void **state)
{
    (void)state;
    Error e;
    assert_null(read_bytes("1 0 0 0 0 1 -1\n\0\0\0", 18, &e));
    assert_int_equal(e.line, 2);
    assert_non_null(strstr(e.message, "not a text file"));
    static char longest[10000];
    memset(longest, '1', sizeof longest);
    assert_null(read_bytes(longest, sizeof longest, &e));
    assert_non_null(strstr(e.message, "longer than"));
    longest[0] = '#'; // comments may be long
    assert_null(read_bytes(longest, sizeof longest, &e));
    assert_non_null(strstr(e.message, "no node in it"));
    assert_null(out_tree_read_swc("/tmp", &e));
    e = (Error){0};
    assert_null(out_tree_read_swc("/tmp/there/is/none.swc", &e));
    assert_non_null(strstr(e.message, "cannot read it"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_written_reads_back_the_same),
        cmocka_unit_test(any_order_comments_and_line_ends_are_read),
        cmocka_unit_test(files_of_neurons_are_read),
        cmocka_unit_test(children_may_come_before_their_parents),
        cmocka_unit_test(numbers_may_look_as_programs_print_them),
        cmocka_unit_test(wrong_files_are_refused),
        cmocka_unit_test(bytes_that_are_no_text_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
