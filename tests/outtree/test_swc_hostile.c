// Broken SWC files: a tree that can be relied on, or an error that names the file.
#include "mutate.h"
#include "testing.h"

#include "outtree/out_tree_io.h"

#include <stdio.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
enum { COPIES = 3000 };
#else
enum { COPIES = 12000 };
#endif

static const char FILE_NAME[] = "/tmp/ramify_test_swc_hostile.swc";

static void write_file(const void *data, size_t size)
{
    unlink(FILE_NAME); // cut to nothing instead, some file systems wait for the disk
    FILE *stream = fopen(FILE_NAME, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

static void tree_or_error(void)
{
    Error e = {0};
    OutTree *tree = out_tree_read_swc(FILE_NAME, &e);
    if (!tree) {
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, FILE_NAME);
        assert_true(e.message[0]);
        return;
    }
    assert_true(tree->count > 0);
    assert_true(out_tree_check(tree, NULL));
    for (int64_t i = 0; i < tree->count; i++) {
        assert_true(tree->birth[i] >= 0 && tree->birth[i] < tree->count);
    }
    out_tree_free(tree);
}

static void survives_broken_copies(void **state)
{
    (void)state;
    static const char sound[] =
        "# SCALE 1 1 1\r\n1 1 0 0 0 6 -1\r\n2 1 0 6 0 6 1\n3 1 0 -6 0 6 1\n5 4 1 60 -3.5e0 1.5 4\n"
        "4 4 0 7 0 2 1\n6 4 -10 120 0 1 5\n\n7 4 15 120 0 .5 5\n10 2 0 -7 1e-3 0.5 1\n"
        "11 2 4 -90 0 0.4 10\n20 0 500 0 0 1 -1\n21 7 500 1 0 1 20";
    for (uint64_t k = 0; k < COPIES; k++) {
        unsigned char copy[1024];
        memcpy(copy, sound, sizeof sound - 1);
        size_t size = mutate(copy, sizeof sound - 1, sizeof copy, random_key(3, k));
        write_file(copy, size);
        tree_or_error();
    }
    unlink(FILE_NAME);
}

// Children before their parents all the way, and one great circle: neither takes long.
static void survives_long_ways(void **state)
{
    (void)state;
    enum { NODES = 200000 };
    char *text = malloc((size_t)NODES * 32), *at = text;
    assert_non_null(text);
    for (int i = NODES; i > 1; i--) {
        at += sprintf(at, "%d 3 %d 0 0 1 %d\n", i, i, i - 1);
    }
    sprintf(at, "1 1 0 0 0 1 -1\n");
    write_file(text, strlen(text));
    OutTree *tree = out_tree_read_swc(FILE_NAME, NULL);
    assert_non_null(tree);
    assert_int_equal(tree->count, NODES);
    assert_int_equal(out_tree_last_birth(tree), NODES - 1);
    out_tree_free(tree);
    sprintf(at, "1 1 0 0 0 1 %d\n", NODES);
    write_file(text, strlen(text));
    tree_or_error();
    free(text);
    unlink(FILE_NAME);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(survives_broken_copies),
        cmocka_unit_test(survives_long_ways),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
