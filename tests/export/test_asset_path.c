#include "testing.h"

#include "export/asset_path.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/ramify_asset_XXXXXX";

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 &&
                   system("mkdir -p a/b ab && touch a/x.png a/b/y.png ab/z.png") == 0
               ? 0
               : -1;
}

static int tear_down(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir("/") == 0 && system(command) == 0 ? 0 : -1;
}

static void expect(const char *file, const char *asset, const char *path)
{
    char *got = asset_path(file, asset, NULL);
    assert_non_null(got);
    assert_string_equal(got, path);
    free(got);
}

static void paths_lead_from_the_file_to_the_asset(void **state)
{
    (void)state;
    char whole[64];
    snprintf(whole, sizeof whole, "%s/a/x.png", folder);
    expect("scene.usda", "a/x.png", "./a/x.png");
    expect("scene.usda", whole, "./a/x.png");
    expect("a/scene.usda", "a/x.png", "./x.png");
    expect("a/b/scene.usda", "a/x.png", "../x.png");
    expect("a/b/scene.usda", "ab/z.png", "../../ab/z.png");
    expect("ab/scene.usda", "a/b/y.png", "../a/b/y.png"); // ab is not within a
    expect("a/scene.usda", "ab/../a/b/y.png", "./b/y.png");
    snprintf(whole, sizeof whole, ".%s/a/x.png", folder);
    expect("/scene.usda", "a/x.png", whole);
}

static void what_is_missing_is_an_error(void **state)
{
    (void)state;
    Error e = {0};
    assert_null(asset_path("scene.usda", "a/none.png", &e));
    assert_int_equal(e.code, ERROR_IO);
    assert_non_null(strstr(e.message, "a/none.png"));
    assert_null(asset_path("none/scene.usda", "a/x.png", &e));
}

static void names_beside_keep_the_folder(void **state)
{
    (void)state;
    const char *const cases[][2] = {{"a.b/scene.usda", "a.b/scene-sky.exr"},
                                    {"scene", "scene-sky.exr"},
                                    {"a.b/scene", "a.b/scene-sky.exr"},
                                    {"a/.usda", "a/.usda-sky.exr"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char *name = asset_beside(cases[i][0], "-sky.exr", NULL);
        assert_string_equal(name, cases[i][1]);
        free(name);
    }
    char *name = asset_of_object("a.b/scene.swc", "oak", NULL);
    assert_string_equal(name, "a.b/scene-oak.swc");
    free(name);
    name = asset_of_object("scene", "oak", NULL);
    assert_string_equal(name, "scene-oak");
    free(name);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_lead_from_the_file_to_the_asset),
        cmocka_unit_test(what_is_missing_is_an_error),
        cmocka_unit_test(names_beside_keep_the_folder),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
