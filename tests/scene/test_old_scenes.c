// Scenes as they were written for older versions (docs/versions.md): they are still read, and grow
// to the bits that were recorded. Each begins with a line for every version in which its bits
// changed:
//
//     # bits 0.1.0 0123456789abcdef
//     # bits 0.2.0 89abcdef01234567 because ...
#include "scene/geometry_hash.h"
#include "testing.h"

#include "base/random.h"
#include "scene/build.h"

#include <glob.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

// Reads the last line of bits. Every line but the first must give a reason.
static bool read_bits(const char *file, uint64_t *bits)
{
    char line[512], version[32];
    FILE *stream = fopen(file, "r");
    assert_non_null(stream);
    int count = 0;
    bool reasons = true;
    while (fgets(line, sizeof line, stream) && line[0] == '#') {
        int end = 0;
        if (sscanf(line, "# bits %31s %" SCNx64 "%n", version, bits, &end) == 2) {
            const char *because = strstr(line + end, " because ");
            reasons = reasons && (count == 0 || (because && strlen(because) > 12));
            count++;
        }
    }
    fclose(stream);
    return count > 0 && reasons;
}

static bool grow(const char *file, uint64_t *bits, Error *e)
{
    Scene *scene = scene_read(file, NULL, 0, e);
    Run run = run_default();
    BuildStats stats = {0};
    World *world = scene ? scene_build(scene, &run, &stats, e) : NULL;
    if (world) {
        *bits = geometry_hash(&world->geometry);
    }
    bool done = world;
    world_free(world);
    scene_free(scene);
    return done;
}

static void old_scenes_have_the_bits_that_were_recorded(void **state)
{
    (void)state;
    glob_t files;
    assert_int_equal(glob("tests/scene/old/*.yaml", 0, NULL, &files), 0);
    assert_true(files.gl_pathc >= 12);
    int wrong = 0;
    for (size_t i = 0; i < files.gl_pathc; i++) {
        const char *file = files.gl_pathv[i];
        uint64_t wanted = 0, bits = 0;
        Error e = {0};
        if (!read_bits(file, &wanted)) {
            print_error("%s has a line of bits without a reason, or none\n", file);
            wrong++;
        }
        if (!grow(file, &bits, &e)) {
            print_error("%s is no longer read: %s\n", file, e.message);
            wrong++;
        } else if (bits != wanted) {
            print_error("%s has %016" PRIx64 ", not the recorded %016" PRIx64 "\n", file, bits,
                        wanted);
            wrong++;
        }
    }
    globfree(&files);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(old_scenes_have_the_bits_that_were_recorded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
