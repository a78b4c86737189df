#include "outtree/out_tree.h"
#include "outtree/out_tree_io.h"
#include "outtree/radii.h"
#include "testing.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

// A trunk of four nodes, from whose end two and three tips leave: 0-1-2-3, 3-(4-5, 6-7), 1-8.
static OutTree *make_tree(void)
{
    static const int parent[9] = {-1, 0, 1, 2, 3, 4, 3, 6, 1};
    OutTree *tree = out_tree_new(NULL);
    assert_non_null(tree);
    for (int i = 0; i < 9; i++) {
        Vec3 at = vec3(0.1f * (float)i, (float)i, 1.0f / 3.0f);
        assert_int_equal(out_tree_add_node(tree, at, parent[i], i, 7, (uint64_t)i, NULL), i);
    }
    return tree;
}

static void nodes_are_kept_and_checked(void **state)
{
    (void)state;
    OutTree *tree = make_tree(), *copy = out_tree_copy(tree, NULL);
    assert_true(out_tree_check(tree, NULL));
    assert_true(out_tree_hash(tree) == out_tree_hash(copy));
    Aabb box = out_tree_bounds(tree);
    assert_true(box.low.y == 0.0f && box.high.y == 8.0f);
    copy->radius[8] = 1e-9f;
    assert_true(out_tree_hash(tree) != out_tree_hash(copy));
    Error e = {0};
    assert_int_equal(out_tree_add_node(copy, vec3(0, 0, 0), 9, 0, 0, 0, &e), -1);
    assert_int_equal(e.code, ERROR_INTERNAL);
    copy->parent[3] = 3;
    assert_false(out_tree_check(copy, &e));
    copy->parent[3] = 2;
    copy->position[5].z = NAN;
    assert_false(out_tree_check(copy, &e));
    assert_non_null(strstr(e.message, "node 5"));
    assert_true(out_tree_child_id(1, 0) != out_tree_child_id(1, 1));
    out_tree_free(tree);
    out_tree_free(copy);
}

static void pipe_radii_conserve_the_sum_of_powers(void **state)
{
    (void)state;
    OutTree *tree = make_tree();
    out_tree_pipe_radii(tree, 2.5f, 0.01f, 0.0f);
    // Three tips reach node 1, two of them node 3.
    assert_true(fabs((double)tree->radius[0] - 0.01 * pow(3.0, 0.4)) < 1e-7);
    assert_true(fabs((double)tree->radius[3] - 0.01 * pow(2.0, 0.4)) < 1e-7);
    assert_true(tree->radius[5] == 0.01f && tree->radius[4] == 0.01f);
    out_tree_pipe_radii(tree, 2.5f, 0.01f, 0.3f);
    assert_true(fabsf(tree->radius[0] - 0.3f) < 1e-5f);
    assert_true(tree->radius[8] == 0.01f);
    double k = log(30.0) / log(3.0);
    assert_true(fabs((double)tree->radius[2] - 0.01 * pow(2.0, k)) < 1e-5);
    tree->count = 4; // never branches
    out_tree_pipe_radii(tree, 2.5f, 0.01f, 0.04f);
    for (int i = 0; i < 4; i++) {
        assert_true(fabsf(tree->radius[i] - (0.04f - 0.01f * (float)i)) < 1e-6f);
    }
    out_tree_free(tree);
}

static void birth_radii_never_grow_outwards(void **state)
{
    (void)state;
    OutTree *tree = make_tree();
    tree->birth[8] = -5; // older than its parent
    out_tree_birth_radii(tree, 0.01f, 0.14f);
    for (int i = 0; i < 9; i++) {
        assert_true(tree->radius[i] >= 0.01f && tree->radius[i] <= 0.14f);
        assert_true(i == 0 || tree->radius[i] <= tree->radius[tree->parent[i]]);
    }
    assert_true(fabsf(tree->radius[7] - 0.01f) < 1e-6f); // the youngest
    assert_true(tree->radius[8] == tree->radius[1]);
    out_tree_free(tree);
}

static void flare_swells_only_the_foot(void **state)
{
    (void)state;
    OutTree *tree = make_tree();
    for (int i = 0; i < 9; i++) {
        tree->radius[i] = 0.1f;
    }
    out_tree_root_flare(tree, 0.5f, 0.0f, 2.0f);
    float step = sqrtf(1.01f), left = 1.0f - step / 2.0f;
    assert_true(fabsf(tree->radius[0] - 0.15f) < 1e-6f);
    assert_true(fabsf(tree->radius[1] - 0.1f * (1.0f + 0.5f * left * left)) < 1e-6f);
    for (int i = 2; i < 9; i++) {
        assert_true(tree->radius[i] == 0.1f);
    }
    out_tree_free(tree);
}

static char *read_all(const char *file)
{
    FILE *stream = fopen(file, "r");
    assert_non_null(stream);
    char *text = calloc(1, 1 << 16);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 16) - 1, stream) > 0);
    fclose(stream);
    return text;
}

static void files_hold_every_bit(void **state)
{
    (void)state;
    char folder[] = "/tmp/ramify-test-XXXXXX", file[64], part[80];
    assert_non_null(mkdtemp(folder));
    OutTree *tree = make_tree();
    out_tree_pipe_radii(tree, 2.3f, 0.01f, 0.2f);
    snprintf(file, sizeof file, "%s/tree.swc", folder);
    snprintf(part, sizeof part, "%s.part", file);
    assert_true(out_tree_write(tree, file, NULL));
    assert_int_not_equal(access(part, F_OK), 0);
    char *text = read_all(file), *line = text;
    for (int i = 0; i < 9; line = strchr(line, '\n') + 1) {
        int number, type, parent;
        float x, y, z, r;
        if (*line == '#') {
            continue;
        }
        assert_int_equal(
            sscanf(line, "%d %d %g %g %g %g %d", &number, &type, &x, &y, &z, &r, &parent), 7);
        assert_int_equal(number, i + 1);
        assert_int_equal(parent, i == 0 ? -1 : tree->parent[i] + 1);
        assert_true(x == tree->position[i].x && y == tree->position[i].y);
        assert_true(z == tree->position[i].z && r == tree->radius[i]);
        i++;
    }
    free(text);
    unlink(file);
    snprintf(file, sizeof file, "%s/tree.json", folder);
    assert_true(out_tree_write(tree, file, NULL));
    text = read_all(file);
    assert_non_null(strstr(text, "\"count\": 9"));
    assert_non_null(strstr(text, "\"parent\": [-1,0,1,2,3,4,3,6,1]"));
    assert_non_null(strstr(text, "\"birth\": [0,1,2,3,4,5,6,7,8]"));
    assert_non_null(strstr(text, "\"0000000000000008\"]}"));
    free(text);
    unlink(file);
    rmdir(folder);
    out_tree_free(tree);
}

static void failures_leave_nothing_behind(void **state)
{
    (void)state;
    OutTree *tree = make_tree();
    Error e = {0};
    assert_false(out_tree_write(tree, "/nowhere/at/all/tree.swc", &e));
    assert_int_equal(e.code, ERROR_IO);
    assert_false(out_tree_write(tree, "/tmp/tree.obj", &e));
    assert_int_equal(e.code, ERROR_INPUT);
    // A disk without room, played by a limit on the size of files: the old file stays.
    char folder[] = "/tmp/ramify-test-XXXXXX", file[64], text[8] = "";
    assert_non_null(mkdtemp(folder));
    snprintf(file, sizeof file, "%s/t.swc", folder);
    FILE *old = fopen(file, "w");
    assert_non_null(old);
    fputs("old", old);
    fclose(old);
    struct rlimit before, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = (struct rlimit){8, before.rlim_max};
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    bool written = out_tree_write(tree, file, &e);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_false(written);
    assert_int_equal(e.code, ERROR_IO);
    old = fopen(file, "r");
    assert_non_null(old);
    assert_non_null(fgets(text, sizeof text, old));
    fclose(old);
    assert_string_equal(text, "old");
    assert_int_equal(remove(file), 0);
    assert_int_equal(rmdir(folder), 0); // and nothing else was left in it
    out_tree_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_are_kept_and_checked),
        cmocka_unit_test(pipe_radii_conserve_the_sum_of_powers),
        cmocka_unit_test(birth_radii_never_grow_outwards),
        cmocka_unit_test(flare_swells_only_the_foot),
        cmocka_unit_test(files_hold_every_bit),
        cmocka_unit_test(failures_leave_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
