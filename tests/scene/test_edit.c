// Values changed in the text of a scene file: comments, layout and order stay.
#include "scene/edit.h"
#include "testing.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The text with "path=value" changes ("a=1\0b=2\0"); the caller frees it.
static char *edit(const char *text, const char *changes, const char *set, bool *whole)
{
    Error e = {0};
    SceneChange list[4];
    char paths[4][96];
    int count = 0;
    for (const char *at = changes; *at; at += strlen(at) + 1) {
        size_t length = strcspn(at, "=");
        snprintf(paths[count], sizeof paths[count], "%.*s", (int)length, at);
        list[count] = (SceneChange){paths[count], at + length + 1, "test", 0, 0};
        count++;
    }
    Scene *scene = scene_read_text(text, strlen(text), "edit.yaml", "", &set, set != NULL, &e);
    assert_non_null(scene);
    char *edited = scene_edited_text(scene, list, count, whole, &e);
    assert_non_null(edited);
    scene_free(scene);
    return edited;
}

static void expect_edit(const char *text, const char *changes, const char *wanted)
{
    bool whole = false;
    char *edited = edit(text, changes, NULL, &whole);
    assert_string_equal(edited, wanted);
    assert_true(whole);
    free(edited);
}

static void values_are_replaced_in_place(void **state)
{
    (void)state;
    expect_edit(
        "# a\nobjects:\n  - name: oak # b\n    tree: {height: 14 , radii: {flare: 0.5}}\n",
        "objects.oak.tree.height=9.25\0objects.0.tree.radii.flare=0.75\0",
        "# a\nobjects:\n  - name: oak # b\n    tree: {height: 9.25 , radii: {flare: 0.75}}\n");
    // columns count characters, lines may end in CR LF
    expect_edit("objects:\r\n- {name: oak, tree: {skin: {levels: 1}, height: 14}} # \xc3\xa4\r\n"
                "- {name: '\xc3\xa4h', tree: {height: 3}}\r\n",
                "objects.1.tree.height=4\0",
                "objects:\r\n- {name: oak, tree: {skin: {levels: 1}, height: 14}} # \xc3\xa4\r\n"
                "- {name: '\xc3\xa4h', tree: {height: 4}}\r\n");
}

static void missing_keys_are_added(void **state)
{
    (void)state;
    expect_edit("objects:\n  - name: oak\n    tree:\n      height: 14 # tall\n      skin:\n        "
                "levels: 1\n",
                "objects.oak.tree.radii.flare=0.5\0",
                "objects:\n  - name: oak\n    tree:\n      height: 14 # tall\n"
                "      radii: {flare: 0.5}\n      skin:\n        levels: 1\n");
    expect_edit("objects: [{name: oak, tree: {}}]\n", "objects.oak.tree.height=5\0seed=3\0",
                "seed: 3\nobjects: [{name: oak, tree: {height: 5}}]\n");
    expect_edit("objects:\n  - name: oak\n    tree: {skin: {levels: 1}}\n",
                "objects.oak.tree.height=5\0",
                "objects:\n  - name: oak\n    tree: {height: 5, skin: {levels: 1}}\n");
    expect_edit("objects:\n  - name: oak\n    tree:\n", "objects.oak.tree.height=5\0",
                "objects:\n  - name: oak\n    tree: {height: 5}\n");
}

static void overrides_go_into_the_text(void **state)
{
    (void)state;
    bool whole = false;
    char *edited = edit("seed: 1 # first\nobjects: [{name: oak, tree: {height: 4}}]\n",
                        "objects.oak.tree.height=5\0", "seed=9", &whole);
    assert_true(whole);
    assert_string_equal(edited, "seed: 9 # first\nobjects: [{name: oak, tree: {height: 5}}]\n");
    free(edited);
}

// Such a text is written out anew and means the same.
static void what_cannot_be_edited_is_written_out(void **state)
{
    (void)state;
    static const char *texts[] = {
        // editing the anchor would change both
        "objects:\n- {name: a, tree: &t {height: 4}}\n- {name: oak, tree: *t}\n",
        "objects:\n- {name: a, tree: &t {height: 4}}\n- name: oak\n  tree:\n    <<: *t\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        bool whole = true;
        Error e = {0};
        char *edited = edit(texts[i], "objects.oak.tree.height=5\0", NULL, &whole);
        assert_false(whole && i == 0);
        const char *both[] = {"objects.oak.tree.height=5"};
        Scene *wanted = scene_read_text(texts[i], strlen(texts[i]), "x", "", both, 1, &e);
        Scene *got = scene_read_text(edited, strlen(edited), "x", "", NULL, 0, &e);
        assert_non_null(wanted);
        assert_non_null(got);
        assert_string_equal(got->resolved, wanted->resolved);
        scene_free(wanted);
        scene_free(got);
        free(edited);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_replaced_in_place),
        cmocka_unit_test(missing_keys_are_added),
        cmocka_unit_test(overrides_go_into_the_text),
        cmocka_unit_test(what_cannot_be_edited_is_written_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
