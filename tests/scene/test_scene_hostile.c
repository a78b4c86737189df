// Broken and malicious scene files: a scene, or an error that says where.
#include "mutate.h"
#include "testing.h"

#include "base/memory.h"
#include "scene/scene.h"

#include <stdio.h>

#ifdef __SANITIZE_ADDRESS__
enum { COPIES = 300 };
#else
enum { COPIES = 2000 };
#endif

static const char *const SOUND[] = {
    "# a tree\n"
    "seed: 7\n"
    "camera: {position: [0, 1.6, 8], target: [0, 1.6, 0], fov: 34, aperture: 0.01}\n"
    "film: {width: 40, height: 40}\n"
    "render: {samples: 4, max_depth: 3}\n"
    "sky: {kind: sun_sky, sun_elevation: 30}\n"
    "materials:\n"
    "  - {name: red, kind: diffuse, color: \"#ff0000\"}\n"
    "  - &glass\n"
    "    name: glass\n"
    "    kind: dielectric\n"
    "    ior: 1.5\n"
    "objects:\n"
    "  - name: tree\n"
    "    tree:\n"
    "      height: 3\n"
    "      crown: {branches: 4, envelope: [{shape: sphere, size: [1, 1, 1], position: [0, 2, "
    "0]}],\n"
    "              growth: {levels: [{attractors: 30, influence: 4}, {attractors: 600}]}}\n"
    "  - {name: ground, ground: {grass_tufts: 0}, material: red}\n"
    "targets:\n"
    "  - {object: tree, measure: height, low: 2, high: 4}\n",
    "objects:\n"
    "  - name: a\n"
    "    lsystem: {axiom: \"FX\", rules: \"X -> [+FX]FX\", angle: 25.5}\n"
    "  - name: b\n"
    "    shape: &s {envelope: [{shape: box, size: [1, 2, 3]}]}\n"
    "  - name: c\n"
    "    shape: {<<: *s, voxel: 0.1}\n"
    "  - name: d\n"
    "    lightning: {}\n"
    "lights:\n"
    "  - {kind: sphere, center: [1, 2, 3], radius: 0.5, radiance: 10}\n"};

static Scene *read_text(const char *text, size_t size, Error *e)
{
    *e = (Error){0};
    return scene_read_text(text, size, "s.yaml", "", NULL, 0, e);
}

static bool scene_or_error(const char *text, size_t size)
{
    Error e;
    Scene *scene = read_text(text, size, &e);
    if (!scene) {
        assert_int_equal(e.code, ERROR_INPUT);
        assert_string_equal(e.file, "s.yaml");
        assert_true(e.message[0]);
    }
    scene_free(scene);
    return scene;
}

static void survives_broken_copies(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SOUND / sizeof SOUND[0]; i++) {
        int sound = 0;
        for (uint64_t k = 0; k < COPIES; k++) {
            unsigned char copy[4096];
            size_t size = strlen(SOUND[i]);
            memcpy(copy, SOUND[i], size);
            size = mutate(copy, size, sizeof copy, random_key(11 + i, k));
            sound += scene_or_error((const char *)copy, size);
        }
        assert_true(sound > 0); // changes within a comment, if nothing else
    }
}

static char *repeat(const char *before, const char *what, int64_t times, const char *after)
{
    size_t length = strlen(what);
    char *text = malloc(strlen(before) + length * (size_t)times + strlen(after) + 1);
    assert_non_null(text);
    char *at = stpcpy(text, before);
    for (int64_t i = 0; i < times; i++) {
        at = stpcpy(at, what);
    }
    strcpy(at, after);
    return text;
}

static void refuses_repeated(const char *before, const char *what, int64_t times, const char *after,
                             const char *words)
{
    Error e;
    char *text = repeat(before, what, times, after);
    assert_null(read_text(text, strlen(text), &e));
    free(text);
    assert_int_equal(e.code, ERROR_INPUT);
    assert_string_equal(e.file, "s.yaml");
    if (words && !strstr(e.message, words)) {
        fail_msg("no '%s' in '%s'", words, e.message);
    }
}

// An error, not an overflow of the stack, however it is nested.
static void refuses_depth(void **state)
{
    (void)state;
    refuses_repeated("objects: ", "[", 1000000, "", "nested deeper");
    refuses_repeated("objects: ", "{a: ", 1000000, "", "nested deeper");
    refuses_repeated("objects:\n ", "- ", 100000, "x", "nested deeper");
    refuses_repeated("", "? ", 100000, "x", NULL);
    refuses_repeated("objects: ", "[", 1000000, "]", "nested deeper");
    char text[8000], *at = text; // through aliases
    at += sprintf(at, "a0: &a0 [1]\n");
    for (int i = 1; i < 200; i++) {
        at += sprintf(at, "a%d: &a%d [*a%d]\n", i, i, i - 1);
    }
    Error e;
    assert_null(read_text(text, strlen(text), &e));
    assert_non_null(strstr(e.message, "nested deeper"));
}

// Ten to the ninth values in ten lines: by aliases, by merges.
static void refuses_bombs(void **state)
{
    (void)state;
    char text[4000], *at = text;
    Error e;
    at += sprintf(at, "a0: &a0 [x,x,x,x,x,x,x,x,x,x]\n");
    for (int i = 1; i < 10; i++) {
        at += sprintf(at, "a%d: &a%d [*a%d,*a%d,*a%d,*a%d,*a%d,*a%d,*a%d,*a%d,*a%d,*a%d]\n", i, i,
                      i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1);
    }
    assert_null(read_text(text, strlen(text), &e));
    assert_int_equal(e.code, ERROR_INPUT);
    assert_non_null(strstr(e.message, "a million values"));
    refuses_repeated("a: &a {k: 1}\nb: {", "<<: *a, ", 900000, "}", NULL);
    refuses_repeated("objects: [", "&a x, ", 2000, "]", "anchors");
    static const char itself[] = "objects: &a [*a]\n";
    assert_null(read_text(itself, sizeof itself - 1, &e));
    assert_int_equal(e.code, ERROR_INPUT);
}

// Much of the same: refused for what it is, and before long.
static void refuses_size(void **state)
{
    (void)state;
    refuses_repeated("objects: [", "x,", 2000000, "]", NULL);
    refuses_repeated("objects:\n", "  - {name: a, ground: {}}\n", 40000, "", NULL);
    refuses_repeated("", "x", 5000000, ": 1", NULL);
    refuses_repeated("seed: ", "9", 5000000, "", NULL);
    refuses_repeated("objects: \"", "\\x41", 1000000, "\"", NULL);
    refuses_repeated("", "#", 5000000, "\n", "the file is empty");
    refuses_repeated("objects: ", "!t ", 1000, "x", NULL);
}

// Peak memory of this process must not grow with the square of a list's length, nor with a text
// times its aliases.
static void refuses_long_values_in_little_memory(void **state)
{
    (void)state;
    static const char before[] = "objects: [{name: a, ground: {}}]\n"
                                 "animation: {tracks: [{path: camera.fov, keys: [{at: 0, value: [";
    int64_t peak = memory_peak();
    refuses_repeated(before, "1,", 60000, "2]}]}]}", "60001 numbers; it must have at most 16");
    char *word = repeat("x: &w \"", "w", 100000, "\"\ny: [");
    refuses_repeated(word, "*w,", 10000, "]", "a million values");
    free(word);
    int64_t grown = (memory_peak() - peak) >> 20;
    if (grown > 1000) {
        fail_msg("%lld MB to refuse 120 kB", (long long)grown);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_long_values_in_little_memory), // first: it watches the peak
        cmocka_unit_test(survives_broken_copies),
        cmocka_unit_test(refuses_depth),
        cmocka_unit_test(refuses_bombs),
        cmocka_unit_test(refuses_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
