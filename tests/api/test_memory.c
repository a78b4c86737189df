// Running out of memory at any point of the way: RAMIFY_MEMORY comes out, nothing else breaks, and
// the next try works. The linker puts our counters before the functions of base/memory.h.
#include "ramify.h"
#include "testing.h"

#include "base/memory.h"

#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

void *__real_memory_alloc(int64_t count, size_t size, Error *e);
void *__real_memory_alloc_zero(int64_t count, size_t size, Error *e);
bool __real_memory_reserve(void *array, int64_t *capacity, int64_t count, size_t size, Error *e);
void *__wrap_memory_alloc(int64_t count, size_t size, Error *e);
void *__wrap_memory_alloc_zero(int64_t count, size_t size, Error *e);
bool __wrap_memory_reserve(void *array, int64_t *capacity, int64_t count, size_t size, Error *e);

static _Atomic long left;    // allocations until one fails; below 0 = none does
static _Atomic bool reached; // it has failed

static bool fails(Error *e)
{
    if (atomic_fetch_sub(&left, 1) != 0) {
        return false;
    }
    reached = true;
    error_set(e, ERROR_MEMORY, "out of memory: a test");
    return true;
}

void *__wrap_memory_alloc(int64_t count, size_t size, Error *e)
{
    return fails(e) ? NULL : __real_memory_alloc(count, size, e);
}

void *__wrap_memory_alloc_zero(int64_t count, size_t size, Error *e)
{
    return fails(e) ? NULL : __real_memory_alloc_zero(count, size, e);
}

bool __wrap_memory_reserve(void *array, int64_t *capacity, int64_t count, size_t size, Error *e)
{
    bool grows = count > *capacity;
    return !(grows && fails(e)) && __real_memory_reserve(array, capacity, count, size, e);
}

static const char bush[] =
    "camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}\n"
    "film: {width: 24, height: 16, denoise: true, bloom: 0.01}\n"
    "render: {samples: 2, max_depth: 2}\n"
    "sky: {kind: sun_sky}\n"
    "lights: [{kind: sphere, center: [3, 4, 3], radius: 0.2, radiance: 5}]\n"
    "objects:\n"
    "  - name: bush\n"
    "    tree: {height: 3, leaves: {max_count: 40}, crown: {lobes: 0, growth: {levels: "
    "[{attractors: 60}]}}}\n"
    "  - {name: floor, ground: {grass_tufts: 90, fallen_leaves: 30}}\n";

static const char net[] = // keeps its attractors, which can be exported
    "objects:\n"
    "  - {name: net, outtree: {growth: {levels: [{attractors: 20}]}}}\n";

static const char *text = bush; // the scene

static RamifyScene *load(RamifyError *error)
{
    return ramify_scene_load_text(text, strlen(text), "memory", "", NULL, 0, error);
}

// One way through a part of the library; the scene is whole.
typedef bool Way(const RamifyScene *scene, RamifyError *error);

static bool way_load(const RamifyScene *scene, RamifyError *error)
{
    (void)scene;
    RamifyScene *own = load(error);
    ramify_scene_free(own);
    return own != NULL;
}

static bool way_schema(const RamifyScene *scene, RamifyError *error)
{
    (void)scene;
    char *schema = ramify_schema(error);
    ramify_free(schema);
    return schema != NULL;
}

static bool way_reference(const RamifyScene *scene, RamifyError *error)
{
    (void)scene;
    char *reference = ramify_schema_markdown(error);
    ramify_free(reference);
    return reference != NULL;
}

static bool way_paths(const RamifyScene *scene, RamifyError *error)
{
    (void)scene;
    char *paths = ramify_schema_paths(error);
    ramify_free(paths);
    return paths != NULL;
}

static bool way_species(const RamifyScene *scene, RamifyError *error)
{
    (void)scene;
    char *species = ramify_species(error);
    ramify_free(species);
    return species != NULL;
}

static bool way_measure(const RamifyScene *scene, RamifyError *error)
{
    RamifyRun run = {.threads = 1};
    RamifyMeasures *measures = ramify_measure(scene, 0, &run, error);
    ramify_measures_free(measures);
    return measures != NULL;
}

static bool way_render(const RamifyScene *scene, RamifyError *error)
{
    static float rgba[4 * 24 * 16];
    RamifyRun run = {.threads = 1};
    return ramify_render(scene, rgba, NULL, &run, error);
}

static bool write_film(const RamifyScene *scene, const char *ending, RamifyError *error)
{
    char file[64];
    RamifyRun run = {.threads = 1};
    snprintf(file, sizeof file, "x%s", ending);
    RamifyFilm *film = ramify_film_new(24, 16, error);
    bool done = film && ramify_film_write(film, scene, file, true, &run, error);
    ramify_film_free(film);
    assert_int_equal(access(file, F_OK) == 0, done); // whole or not there
    unlink(file);
    return done;
}

static bool way_png(const RamifyScene *scene, RamifyError *error)
{
    return write_film(scene, ".png", error);
}

static bool way_exr(const RamifyScene *scene, RamifyError *error)
{
    return write_film(scene, ".exr", error);
}

static const char *ending; // of the format that way_export writes

static bool way_export(const RamifyScene *scene, RamifyError *error)
{
    char file[64];
    RamifyRun run = {.threads = 1};
    snprintf(file, sizeof file, "x%s", ending);
    bool done = ramify_export(scene, file, NULL, &run, NULL, error);
    assert_int_equal(access(file, F_OK) == 0, done);
    unlink(file);
    return done;
}

// Lets each of the first `all` allocations fail, then some further on, until the way gets through.
static void let_each_fail(Way *way, long all)
{
    RamifyScene *scene = load(NULL);
    assert_non_null(scene);
    bool done = false;
    for (long at = 0; !done; at += at < all ? 1 : 1 + at / 4) {
        RamifyError error = {0};
        reached = false;
        left = at;
        done = way(scene, &error);
        left = -1;
        if (reached && done) {
            fail_msg("allocation %ld failed and nobody said so", at);
        }
        if (!done && (error.code != RAMIFY_MEMORY || !*error.message)) {
            fail_msg("allocation %ld failed: code %d, %s", at, error.code, error.message);
        }
    }
    assert_false(reached);
    ramify_scene_free(scene);
}

static void reading_a_scene(void **state)
{
    (void)state;
    let_each_fail(way_load, 200);
}

static void printing_the_schema(void **state)
{
    (void)state;
    let_each_fail(way_schema, 50);
    let_each_fail(way_reference, 50);
    let_each_fail(way_paths, 50);
    let_each_fail(way_species, 50);
}

static void growing_and_measuring(void **state)
{
    (void)state;
    let_each_fail(way_measure, 80);
}

static void building_and_tracing(void **state)
{
    (void)state;
    let_each_fail(way_render, 30);
}

static void developing_a_picture(void **state)
{
    (void)state;
    let_each_fail(way_png, 60);
    let_each_fail(way_exr, 60);
}

static void exporting(void **state)
{
    (void)state;
    for (int i = 0; i < ramify_export_format_count(); i++) {
        ending = ramify_export_format_ending(i);
        bool heights =
            strstr(".png .exr .asc .tif", ending); // of a terrain, which this scene lacks
        text = strcmp(ending, ".csv") == 0 ? net : bush;
        if (!heights) {
            let_each_fail(way_export, 8);
        }
    }
    text = bush;
}

// All files go to a folder of their own: some formats write others beside theirs.
static int enter_folder(void **state)
{
    static char folder[] = "/tmp/ramify_memory_XXXXXX";
    *state = folder;
    return mkdtemp(folder) ? chdir(folder) : -1;
}

static int leave_folder(void **state)
{
    char command[80];
    snprintf(command, sizeof command, "rm -rf '%s'", (const char *)*state);
    return chdir("/") || system(command);
}

int main(void)
{
    left = -1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_a_scene),       cmocka_unit_test(printing_the_schema),
        cmocka_unit_test(growing_and_measuring), cmocka_unit_test(building_and_tracing),
        cmocka_unit_test(developing_a_picture),  cmocka_unit_test(exporting),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
