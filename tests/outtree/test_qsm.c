// Reading QSM: a tree of cylinders whose measures are known, its notations, and what is refused.
#include "base/measures.h"
#include "mutate.h"
#include "outtree/measure.h"
#include "outtree/out_tree_io.h"
#include "testing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
enum { COPIES = 2000 };
#else
enum { COPIES = 8000 };
#endif

static const char FILE_NAME[] = "/tmp/ramify_test_qsm.txt";

// A stem of three cylinders; at 1 m a side branch at right angles, whose cylinder begins at the
// stem's surface, and at 1.5 m one of two cylinders under acos(0.8), whose axis meets the stem's
// inside the second cylinder. Coordinates are those of a map. Child before parent: row 4.
#define STEM                                                    \
    "0.3\t1\t500000\t6000000\t100\t0\t0\t1\t0\t2\t1\t0\t1\t0\n" \
    "0.2\t1\t500000\t6000000\t101\t0\t0\t1\t1\t3\t1\t0\t2\t0\n" \
    "0.1\t1\t500000\t6000000\t102\t0\t0\t1\t2\t0\t1\t0\t3\t0\n"
#define BRANCHES                                                             \
    "0.04\t0.25\t500000.6\t6000000\t102.3\t0.6\t0\t0.8\t5\t0\t2\t1\t2\t0\n"  \
    "0.05\t0.75\t500000.15\t6000000\t101.7\t0.6\t0\t0.8\t2\t4\t2\t1\t1\t0\n" \
    "0.06\t0.7\t500000\t6000000.3\t101\t0\t1\t0\t1\t0\t3\t1\t1\t1\n"
#define HEADER /* of TreeQSM 2.4 */                                               \
    "radius (m)\tlength "                                                         \
    "(m)\tstart_point\taxis_direction\tparent\textension\tbranch\tbranch_order\t" \
    "position_in_branch\tmad\tSurfCov\tadded\tUnmodRadius (m)\n"
#define ROOT "0.3 1 0 0 0 0 0 1 0 0 1 0 1 0\n"

static void write_file(const void *data, size_t size)
{
    unlink(FILE_NAME);
    FILE *stream = fopen(FILE_NAME, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

static OutTree *read_text(const char *text, Error *e)
{
    write_file(text, strlen(text));
    *e = (Error){0};
    OutTree *tree = out_tree_read_qsm(FILE_NAME, e);
    unlink(FILE_NAME);
    return tree;
}

static OutTree *read_sound(const char *text)
{
    Error e;
    OutTree *tree = read_text(text, &e);
    if (!tree) {
        fail_msg("%d:%d: %s", e.line, e.column, e.message);
    }
    assert_true(out_tree_check(tree, NULL));
    return tree;
}

static void assert_node(const OutTree *tree, Vec3 position, float radius)
{
    for (int64_t i = 0; i < tree->count; i++) {
        if (vec3_distance(tree->position[i], position) < 1e-5f && tree->radius[i] == radius) {
            return;
        }
    }
    fail_msg("no node at %g %g %g", (double)position.x, (double)position.y, (double)position.z);
}

static void cylinders_become_nodes_with_y_up(void **state)
{
    (void)state;
    OutTree *tree = read_sound(STEM BRANCHES);
    assert_int_equal(tree->count, 8);
    assert_node(tree, vec3(0, 0, 0), 0.3f);
    assert_node(tree, vec3(0, 1, 0), 0.3f);
    assert_node(tree, vec3(0, 1.5f, 0), 0.2f);
    assert_node(tree, vec3(0, 2, 0), 0.2f);
    assert_node(tree, vec3(0, 3, 0), 0.1f);
    assert_node(tree, vec3(0.6f, 2.3f, 0), 0.05f);
    assert_node(tree, vec3(0.75f, 2.5f, 0), 0.04f);
    assert_node(tree, vec3(0, 1, -1), 0.06f);
    double volume = 0.0;
    for (int64_t i = 1; i < tree->count; i++) {
        double r = (double)tree->radius[i];
        volume += r * r * (double)vec3_distance(tree->position[i], tree->position[tree->parent[i]]);
    }
    double branches = 0.05 * 0.05 + 0.04 * 0.04 * 0.25 + 0.06 * 0.06;
    assert_true(fabs(volume - (0.09 + 0.04 + 0.01 + branches)) < 1e-6);
    out_tree_free(tree);
}

static void measures_have_their_closed_form(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double value;
    } wanted[] = {{"nodes", 8},
                  {"roots", 1},
                  {"forks", 2},
                  {"terminals", 3},
                  {"most_children", 2},
                  {"height", 3},
                  {"width", 0.75},
                  {"depth", 1},
                  {"length", 5.25},
                  {"longest_path", 3},
                  {"turning", 0},
                  {"root_radius", 0.3},
                  {"tip_radius", 0.2 / 3},
                  {"main_angle", 0},
                  {"branch_angle", 63.434949},
                  {"strahler_order", 2},
                  {"horton_number", 3}};
    OutTree *tree = read_sound(STEM BRANCHES);
    MeasureList list = {0};
    assert_true(out_tree_measure(tree, &list, NULL));
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        const Measure *measure = measures_find(&list, wanted[i].name);
        assert_non_null(measure);
        double value = measure->value;
        if (!(fabs(value - wanted[i].value) < 1e-5 * fmax(1.0, wanted[i].value))) {
            fail_msg("%s is %g, not %g", wanted[i].name, value, wanted[i].value);
        }
    }
    measures_clear(&list);
    out_tree_free(tree);
}

static void every_version_and_notation_gives_the_same_tree(void **state)
{
    (void)state;
    static const char named[] =
        HEADER "0.3\t1\t0\t0\t0\t0\t0\t1\t0\t0\t1\t0\t1\tNaN\t0.9\t0\t0.31\n";
    const char *const same[] = {
        ROOT,
        "# of a scan\r\n\r\n 0.3,1, 0,0 ,0,0,0,1,0,0,1,0,1,0 \r\n",
        "0.3 1 0 0 0 0 0 1 0 0 1 0 1 0 0.31",
        named,
        "\xef\xbb\xbf\"radius\",\"length\"\n3e-1 +1 7 -8 9 0 0 0.9999 0 0 1 0 1 0\n",
    };
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        OutTree *tree = read_sound(same[i]);
        assert_int_equal(tree->count, 2);
        assert_true(tree->position[0].y == 0.0f && tree->position[1].y == 1.0f);
        assert_true(tree->position[1].x == 0.0f && tree->position[1].z == 0.0f);
        assert_true(tree->radius[0] == 0.3f && tree->radius[1] == 0.3f);
        out_tree_free(tree);
    }
}

// Branches that leave below, above, and beside their parent along its axis, two at one place, and
// one that rounding has moved off the end.
static void side_branches_begin_on_their_parent(void **state)
{
    (void)state;
    OutTree *tree = read_sound(ROOT "0.1 1 0 0 -1 1 0 0 1 0 2 1 1 0\n"
                                    "0.1 1 0.5 0 5 0 0 1 1 0 3 1 1 0\n"
                                    "0.1 1 0.5 0 0.5 1 0 0 1 0 4 1 1 0\n"
                                    "0.1 1 0 0.5 0.5 0 1 0 1 0 5 1 1 0\n"
                                    "0.1 1 0.5 0 0.25 -1 0 0 1 0 6 1 1 0\n"
                                    "0.1 1 0 0.5 0.9999 0 1 0 1 0 7 1 1 0\n");
    static const float from[] = {0.0f, 1.0f, 0.5f, 0.5f, 0.25f, 1.0f};
    Vec3 to[] = {vec3(1, -1, 0),       vec3(0.5f, 6, 0),      vec3(1.5f, 0.5f, 0),
                 vec3(0, 0.5f, -1.5f), vec3(-0.5f, 0.25f, 0), vec3(0, 0.9999f, -1.5f)};
    int found = 0;
    assert_int_equal(tree->count, 2 + 2 + 6);
    for (int64_t i = 0; i < tree->count; i++) {
        for (int k = 0; k < 6; k++) {
            if (vec3_distance(tree->position[i], to[k]) < 1e-6f) {
                assert_true(tree->position[tree->parent[i]].y == from[k]);
                found++;
            }
        }
    }
    assert_int_equal(found, 6);
    out_tree_free(tree);
}

static void wrong_files_are_refused_with_their_place(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
        int line, column;
    } wrong[] = {
        {"", "no cylinder in it", 0, 0},
        {"radius length\n# none\n", "no cylinder in it", 0, 0},
        {ROOT "0.1 1 0 0\n", "4 numbers in the line", 2, 9},
        {"1\n", "1 number in the line", 1, 1},
        {ROOT "0.1 1 0 0 1 0 0 1 1 0 1 0 2 0 7\n", "it must hold 14, as", 2, 31},
        {"1 1 0 0 0 0 0 1 0 0 1 0 1 0 1 1 1 18\n", "'18' after 17 numbers", 1, 35},
        {"1 1 0 0 0 0 0 one 0 0 1 0 1 0\n", "'one 0 0 1 0 1 0' is no number", 1, 15},
        {"1 1 0,,0 0 0 1 0 0 1 0 1 0 0\n", "',0 0 0 1 0 0 1 0 1 0' is no number", 1, 7},
        {ROOT "radius length\n", "'radius length' is no number", 2, 1},
        {"type,radius\n", "'type,radius' is no number", 1, 1},
        {"-0.3 1 0 0 0 0 0 1 0 0 1 0 1 0\n", "radius -0.3", 1, 1},
        {"0.3 -1 0 0 0 0 0 1 0 0 1 0 1 0\n", "length -1", 1, 5},
        {"nan 1 0 0 0 0 0 1 0 0 1 0 1 0\n", "nan in column 1", 1, 1},
        {"1 1 0 0 1e13 0 0 1 0 0 1 0 1 0\n", "1e+13 in column 5", 1, 9},
        {"1 1 0 0 0 0 0 2 0 0 1 0 1 0\n", "axis 0 0 2 of length 2", 1, 11},
        {"1 1 0 0 0 0 0 0 0 0 1 0 1 0\n", "axis 0 0 0 of length 0", 1, 11},
        {ROOT "1 1 0 0 0 0 0 1 3 0 1 0 1 0\n", "parent 3; the table has 2 cylinders", 2, 17},
        {"1 1 0 0 0 0 0 1 -1 0 1 0 1 0\n", "parent -1", 1, 17},
        {"1 1 0 0 0 0 0 1 0.5 0 1 0 1 0\n", "parent 0.5", 1, 17},
        {"1 1 0 0 0 0 0 1 0 nan 1 0 1 0\n", "extension nan", 1, 19},
        {ROOT "1 1 0 0 0 0 0 1 1 3 1 0 1 0\n", "extension 3; the table has 2", 2, 19},
        {"1 1 0 0 0 0 0 1 1 0 1 0 1 0\n", "cylinder 1 is its own ancestor", 1, 17},
        {ROOT "1 1 0 0 0 0 0 1 3 0 1 0 1 0\n1 1 0 0 0 0 0 1 3 0 1 0 1 0\n",
         "cylinder 3 is its own ancestor", 3, 17},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        Error e;
        assert_null(read_text(wrong[i].text, &e));
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, FILE_NAME);
        if (!strstr(e.message, wrong[i].says) || e.line != wrong[i].line ||
            e.column != wrong[i].column) {
            fail_msg("%d:%d: '%s' is not %d:%d '%s'", e.line, e.column, e.message, wrong[i].line,
                     wrong[i].column, wrong[i].says);
        }
    }
}

static void broken_copies_give_a_tree_or_an_error(void **state)
{
    (void)state;
    static const char sound[] = "radius (m)\tlength (m)\n" STEM BRANCHES "\n";
    for (uint64_t k = 0; k < COPIES; k++) {
        unsigned char copy[1024];
        memcpy(copy, sound, sizeof sound - 1);
        size_t size = mutate(copy, sizeof sound - 1, sizeof copy, random_key(5, k));
        write_file(copy, size);
        Error e = {0};
        OutTree *tree = out_tree_read_qsm(FILE_NAME, &e);
        if (tree) {
            assert_true(tree->count > 1);
            assert_true(out_tree_check(tree, NULL));
        } else {
            assert_int_equal(e.code, ERROR_INPUT);
            assert_string_equal(e.file, FILE_NAME);
            assert_true(e.message[0]);
        }
        out_tree_free(tree);
    }
    unlink(FILE_NAME);
}

// A chain whose last cylinder comes first, and which hangs on `root`. free() it.
static char *chain_text(int cylinders, int root)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    for (int i = 1; i < cylinders; i++) {
        fprintf(out, "1 1 0 0 %d 0 0 1 %d %d 1 0 1 0\n", cylinders - i, i + 1, i - 1);
    }
    fprintf(out, "1 1 0 0 0 0 0 1 %d %d 1 0 1 0\n", root, cylinders - 1);
    fclose(out);
    return text;
}

// As a chain and as one great loop: neither takes long.
static void long_chains_are_read(void **state)
{
    (void)state;
    enum { CYLINDERS = 100000 };
    char *chain = chain_text(CYLINDERS, 0), *loop = chain_text(CYLINDERS, 1);
    OutTree *tree = read_sound(chain);
    assert_int_equal(tree->count, CYLINDERS + 1);
    assert_int_equal(out_tree_last_birth(tree), CYLINDERS);
    out_tree_free(tree);
    Error e;
    assert_null(read_text(loop, &e));
    assert_non_null(strstr(e.message, "is its own ancestor"));
    free(chain);
    free(loop);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cylinders_become_nodes_with_y_up),
        cmocka_unit_test(measures_have_their_closed_form),
        cmocka_unit_test(every_version_and_notation_gives_the_same_tree),
        cmocka_unit_test(side_branches_begin_on_their_parent),
        cmocka_unit_test(wrong_files_are_refused_with_their_place),
        cmocka_unit_test(broken_copies_give_a_tree_or_an_error),
        cmocka_unit_test(long_chains_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
