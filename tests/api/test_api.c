// The public C API: from a text to out-trees, measures, land, geometry, pictures and files, by
// ramify.h alone.
#include "image/image.h"
#include "ramify.h"
#include "testing.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { WIDTH = 24, HEIGHT = 16 };

static const char text[] = "camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}\n"
                           "film: {width: 24, height: 16}\n"
                           "render: {samples: 2, max_depth: 2}\n"
                           "sky: {kind: constant, color: 1}\n"
                           "objects:\n"
                           "  - name: bush\n"
                           "    tree: {height: 3, leaves: {max_count: 40}, crown: {lobes: 0, "
                           "growth: {levels: [{attractors: 60}]}}}\n"
                           "  - {name: ball, shape: {envelope: [{shape: sphere}]}}\n"
                           "  - {name: hill, terrain: {size: 500, relief: 60, resolution: 32, "
                           "rivers: {count: 20}}}\n"
                           "  - {name: leaf, venation: {detail: 12}}\n"
                           "targets: [{object: bush, measure: height, low: 1}]\n";

enum { BUSH, BALL, HILL, LEAF, OBJECTS };

static RamifyScene *load(void)
{
    RamifyError error = {0};
    RamifyScene *scene = ramify_scene_load_text(text, strlen(text), "api", "", NULL, 0, &error);
    if (!scene) {
        fail_msg("%s", error.message);
    }
    return scene;
}

static void a_scene_tells_what_it_holds(void **state)
{
    (void)state;
    int width, height;
    RamifyScene *scene = load();
    ramify_scene_size(scene, &width, &height);
    assert_int_equal(width, 24);
    assert_int_equal(height, 16);
    assert_int_equal(ramify_scene_object_count(scene), OBJECTS);
    assert_string_equal(ramify_scene_object_name(scene, BALL), "ball");
    assert_non_null(strstr(ramify_scene_resolved(scene), "phyllotaxis"));
    assert_string_equal(ramify_version(), RAMIFY_VERSION);
    ramify_scene_free(scene);
}

static void infos_are_those_of_the_text(void **state)
{
    (void)state;
    static const char *const kinds[OBJECTS] = {"tree", "shape", "terrain", "venation"};
    RamifyScene *scene = load();
    RamifySceneInfo info;
    RamifyTarget target;
    ramify_scene_info(scene, &info);
    assert_string_equal(info.file, "api");
    assert_true(info.width == WIDTH && info.height == HEIGHT && info.samples == 2);
    assert_true(info.crop[0] == 0.0f && info.crop[3] == 1.0f && info.grow_to == 1.0f);
    assert_true(info.object_count == OBJECTS && info.target_count == 1);
    assert_true(info.memory > WIDTH * HEIGHT * 16);
    assert_string_equal(ramify_scene_text(scene), text);
    ramify_scene_target(scene, 0, &target);
    assert_string_equal(target.object, "bush");
    assert_string_equal(target.measure, "height");
    assert_true(target.low == 1.0 && target.high > DBL_MAX); // no bound is infinity
    for (int i = 0; i < OBJECTS; i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        assert_string_equal(object.kind, kinds[i]);
        assert_int_equal(object.grows, i != BALL);
        assert_int_equal(object.is_land, i == HILL);
        assert_int_equal(object.paints, i == LEAF);
        assert_true(object.seed != 0);
        assert_true(i == BUSH ? object.attractors > 0 : i != BALL || object.attractors == 0);
        assert_true((object.instances == 40) == (i == BUSH));
    }
    ramify_scene_free(scene);
}

static void hints_know_the_nearest_word(void **state)
{
    (void)state;
    static const char *const known[] = {"render", "grow", "measure"};
    char hint[100];
    assert_int_equal(ramify_nearest("gorw", known, 3), 1);
    assert_int_equal(ramify_nearest("xyzzyx", known, 3), -1);
    ramify_suggest("rendre", known, 3, hint, sizeof hint);
    assert_string_equal(hint, "did you mean 'render'?");
    ramify_suggest("xyzzyx", known, 3, hint, sizeof hint);
    assert_string_equal(hint, "known: render, grow, measure");
}

static void errors_carry_their_place(void **state)
{
    (void)state;
    RamifyError error = {0};
    char message[1200];
    const char *const overrides[] = {"camera.fov=0"};
    assert_null(ramify_scene_load_text("seed: x\n", 8, "api", "", NULL, 0, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    ramify_error_format(&error, message, sizeof message);
    assert_string_equal(message, "api:1:7: seed is 'x'; it must be a whole number");
    assert_null(ramify_scene_load_text(text, strlen(text), "api", "", overrides, 1, NULL));
    assert_null(ramify_scene_load("/nope", NULL, 0, &error));
    assert_string_equal(error.file, "/nope");
}

static void growth_gives_an_out_tree(void **state)
{
    (void)state;
    RamifyError error = {0};
    RamifyScene *scene = load();
    RamifyTree *tree = ramify_grow(scene, BUSH, NULL, &error);
    assert_non_null(tree);
    int64_t count = ramify_tree_count(tree);
    const int32_t *parents = ramify_tree_parents(tree);
    const float *positions = ramify_tree_positions(tree), *radii = ramify_tree_radii(tree);
    assert_true(count > 20);
    for (int64_t i = 0; i < count; i++) {
        assert_true(parents[i] < i && parents[i] >= -1);
        assert_true(radii[i] > 0.0f && isfinite(positions[3 * i + 2]));
        assert_true(ramify_tree_births(tree)[i] >= 0);
    }
    ramify_tree_free(tree);
    assert_null(ramify_grow(scene, BALL, NULL, &error));
    assert_string_equal(error.message,
                        "object 'ball': it does not grow; objects of kind shape have no growth");
    assert_null(ramify_grow(scene, OBJECTS, NULL, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    ramify_scene_free(scene);
}

static void an_out_tree_survives_its_file(void **state)
{
    (void)state;
    RamifyError error = {0};
    float low[3], high[3], read_low[3], read_high[3];
    char swc[] = "/tmp/ramify_api_XXXXXX.swc";
    int descriptor = mkstemps(swc, 4);
    assert_true(descriptor >= 0);
    close(descriptor);
    RamifyScene *scene = load();
    RamifyTree *tree = ramify_grow(scene, BUSH, NULL, NULL);
    assert_true(ramify_tree_write(tree, swc, &error));
    RamifyTree *read = ramify_tree_read(swc, NULL, &error);
    assert_non_null(read);
    volatile int cancelled = 1;
    RamifyRun interrupted = {.cancelled = &cancelled};
    assert_null(ramify_tree_read(swc, &interrupted, &error)); // in a child that is waited for
    assert_int_equal(error.code, RAMIFY_CANCELLED);
    assert_int_equal(unlink(swc), 0);
    assert_int_equal(ramify_tree_count(tree), ramify_tree_count(read));
    ramify_tree_bounds(tree, low, high);
    ramify_tree_bounds(read, read_low, read_high);
    assert_memory_equal(low, read_low, sizeof low);
    assert_memory_equal(high, read_high, sizeof high);
    RamifyTree *again = ramify_grow(scene, BUSH, NULL, NULL);
    assert_true(ramify_tree_hash(tree) == ramify_tree_hash(again));
    assert_memory_equal(ramify_tree_ids(tree), ramify_tree_ids(again),
                        8 * (size_t)ramify_tree_count(tree));
    for (int64_t i = 0; i < ramify_tree_count(tree); i++) {
        const float *n = ramify_tree_normals(tree) + 3 * i;
        assert_true(fabsf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0f) < 1e-3f);
        assert_true(ramify_tree_colonies(tree)[i] >= 0);
    }
    assert_false(ramify_tree_write(tree, "/tmp/x.tga", &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    assert_null(ramify_tree_read("/nope.swc", NULL, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    ramify_tree_free(again);
    ramify_tree_free(read);
    ramify_tree_free(tree);
    ramify_scene_free(scene);
}

static void measures_are_those_of_the_tree(void **state)
{
    (void)state;
    RamifyError error = {0};
    RamifyMeasure nodes, height;
    float low[3], high[3];
    RamifyScene *scene = load();
    RamifyTree *tree = ramify_grow(scene, BUSH, NULL, NULL);
    RamifyMeasures *measures = ramify_measure(scene, BUSH, NULL, &error);
    assert_non_null(measures);
    ramify_measures_get(measures, ramify_measures_find(measures, "nodes"), &nodes);
    ramify_measures_get(measures, ramify_measures_find(measures, "height"), &height);
    ramify_tree_bounds(tree, low, high);
    assert_true(nodes.value == (double)ramify_tree_count(tree) && *nodes.unit == 0);
    assert_true(fabs(height.value - (double)(high[1] - low[1])) < 1e-5);
    assert_string_equal(height.unit, "m");
    assert_int_equal(ramify_measures_find(measures, "heigth"), -1);
    RamifyMeasures *of_tree = ramify_tree_measure(tree, &error);
    assert_true(ramify_measures_count(of_tree) <= ramify_measures_count(measures));
    RamifyMeasures *of_ball = ramify_measure(scene, BALL, NULL, &error);
    RamifyMeasure triangles, width;
    ramify_measures_get(of_ball, ramify_measures_find(of_ball, "triangles"), &triangles);
    ramify_measures_get(of_ball, ramify_measures_find(of_ball, "width"), &width);
    assert_true(triangles.value > 100.0);
    assert_true(fabs(width.value - 2.0) < 0.01); // a sphere of radius 1
    assert_null(ramify_measure(scene, OBJECTS, NULL, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    ramify_measures_free(of_ball);
    ramify_measures_free(of_tree);
    ramify_measures_free(measures);
    ramify_tree_free(tree);
    ramify_scene_free(scene);
}

static void all_measures_are_those_of_each(void **state)
{
    (void)state;
    RamifyError error = {0};
    RamifyScene *scene = load();
    RamifyMeasures *all[OBJECTS];
    assert_true(ramify_measure_objects(scene, NULL, all, NULL, &error));
    for (int i = 0; i < OBJECTS; i++) {
        RamifyMeasures *one = ramify_measure(scene, i, NULL, &error);
        assert_int_equal(ramify_measures_count(all[i]), ramify_measures_count(one));
        for (int k = 0; k < ramify_measures_count(one); k++) {
            RamifyMeasure a, b;
            ramify_measures_get(all[i], k, &a);
            ramify_measures_get(one, k, &b);
            assert_string_equal(a.name, b.name);
            assert_memory_equal(&a.value, &b.value, sizeof a.value);
        }
        ramify_measures_free(one);
        ramify_measures_free(all[i]);
    }
    bool wanted[OBJECTS] = {[BALL] = true};
    assert_true(ramify_measure_objects(scene, wanted, all, NULL, &error));
    for (int i = 0; i < OBJECTS; i++) {
        assert_true((all[i] != NULL) == wanted[i]);
        ramify_measures_free(all[i]);
    }
    volatile int cancelled = 1;
    RamifyRun stopped = {.cancelled = &cancelled};
    assert_false(ramify_measure_objects(scene, NULL, all, &stopped, &error));
    assert_int_equal(error.code, RAMIFY_CANCELLED);
    for (int i = 0; i < OBJECTS; i++) {
        assert_null(all[i]);
    }
    ramify_scene_free(scene);
}

static void land_has_heights(void **state)
{
    (void)state;
    RamifyError error = {0};
    RamifyLandInfo info, same;
    RamifyScene *scene = load();
    RamifyTree *tree = ramify_grow(scene, HILL, NULL, NULL);
    RamifyLand *land = ramify_land(scene, HILL, tree, NULL, &error);
    RamifyLand *grown = ramify_land(scene, HILL, NULL, NULL, &error); // grows the tree itself
    assert_true(land && grown);
    ramify_land_info(land, &info);
    ramify_land_info(grown, &same);
    assert_true(info.hash == same.hash && info.columns >= 32 && info.rows >= 32);
    assert_true(info.low < info.high && info.cell[0] > 0.0f);
    const float *heights = ramify_land_heights(land);
    float low = INFINITY;
    for (int64_t i = 0; i < (int64_t)info.columns * info.rows; i++) {
        low = heights[i] < low ? heights[i] : low;
    }
    assert_true(low == info.low);
    RamifyMeasures *measures = ramify_land_measure(land, &error);
    assert_true(ramify_measures_find(measures, "hypsometric_integral") >= 0);
    RamifyLand *slope = ramify_land_map(land, "slope", &error);
    assert_non_null(slope);
    ramify_land_info(slope, &same);
    assert_true(same.columns == info.columns && same.low >= 0.0f && same.high < 90.0f);
    ramify_land_free(slope);
    assert_null(ramify_land_map(land, "beauty", &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    assert_null(ramify_land_tile(scene, HILL, land, NULL, 0, 0, NULL, &error));
    assert_non_null(strstr(error.message, "it is not cut into tiles"));
    assert_false(ramify_land_write(land, "/tmp/x.tga", &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    assert_null(ramify_land(scene, BALL, NULL, NULL, &error));
    assert_string_equal(error.message, "object 'ball': it is not land; only a terrain has heights");
    ramify_measures_free(measures);
    ramify_land_free(grown);
    ramify_land_free(land);
    ramify_tree_free(tree);
    ramify_scene_free(scene);
}

static void a_leaf_paints_its_veins(void **state)
{
    (void)state;
    RamifyError error = {0};
    float pixel[WIDTH * HEIGHT], least = 1.0f, most = 0.0f;
    RamifyScene *scene = load();
    RamifyTree *tree = ramify_grow(scene, LEAF, NULL, NULL);
    assert_true(ramify_paint(scene, LEAF, tree, WIDTH, HEIGHT, pixel, &error));
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        least = fminf(least, pixel[i]);
        most = fmaxf(most, pixel[i]);
    }
    assert_true(least >= 0.0f && most <= 1.0f && most > least);
    assert_false(ramify_paint(scene, BUSH, tree, WIDTH, HEIGHT, pixel, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    ramify_tree_free(tree);
    ramify_scene_free(scene);
}

// Looks at every number of a part; a sanitizer sees whether the arrays are as long as they say.
static void check_part(const RamifyPart *part)
{
    bool curves = part->face_size == 0;
    assert_true(part->object >= 0 && part->object < OBJECTS && part->material);
    assert_true(part->vertex_count > 0 && part->positions);
    assert_true(curves ? part->curve_count > 0 : part->face_count > 0);
    for (int64_t i = 0; i < 3 * part->vertex_count; i++) {
        assert_true(isfinite(part->positions[i]));
        assert_true(!part->normals || isfinite(part->normals[i]));
        assert_true(!part->uvs || i >= 2 * part->vertex_count || isfinite(part->uvs[i]));
    }
    for (int64_t i = 0; i < part->vertex_count; i++) {
        assert_true(!part->radii || part->radii[i] >= 0.0f);
        assert_true(!part->births || (part->births[i] >= 0.0f && part->births[i] <= 1.0f));
    }
    for (int64_t i = 0; i < part->face_count * part->face_size; i++) {
        assert_true(part->indices[i] < part->vertex_count);
    }
    for (int64_t i = 0; i < part->curve_count; i++) {
        assert_true(part->starts[i] + 2 <= part->starts[i + 1]);
        assert_true(part->starts[i + 1] <= part->vertex_count);
    }
    for (int64_t i = 0; i < part->instance_count * 12; i++) {
        assert_true(isfinite(part->instances[i]));
    }
}

static void a_world_hands_out_its_parts(void **state)
{
    (void)state;
    RamifyError error = {0};
    RamifyWorldInfo info;
    RamifyScene *scene = load();
    RamifyWorld *world = ramify_build(scene, NULL, &error);
    assert_non_null(world);
    ramify_world_info(world, &info);
    int64_t triangles = 0, segments = 0, instances = 0;
    for (int64_t i = 0; i < ramify_world_part_count(world); i++) {
        RamifyPart part;
        ramify_world_part(world, i, &part);
        check_part(&part);
        triangles += part.face_count * (part.face_size - 2);
        segments += part.curve_count > 0 ? part.vertex_count - part.curve_count : 0;
        instances += part.instance_count;
    }
    assert_int_equal(triangles, info.triangles);
    assert_int_equal(segments, info.curve_segments);
    assert_int_equal(instances, info.instances);
    assert_true(info.nodes > 0 && instances > 0);
    ramify_world_free(world);
    ramify_scene_free(scene);
}

static void export_knows_its_formats(void **state)
{
    (void)state;
    RamifyError error = {0};
    RamifyScene *scene = load();
    assert_true(ramify_export_format_count() > 0);
    for (int i = 0; i < ramify_export_format_count(); i++) {
        char name[40];
        snprintf(name, sizeof name, "x%s", ramify_export_format_ending(i));
        assert_true(ramify_export_check(name, &error));
        assert_true(strlen(ramify_export_format_doc(i)) > 0);
    }
    assert_false(ramify_export_check("x.xyz", &error));
    assert_false(ramify_export(scene, "/nope/x.stl", NULL, NULL, NULL, &error));
    assert_int_equal(error.code, RAMIFY_IO);
    ramify_scene_free(scene);
}

static void count_progress(void *user, const char *stage, double done)
{
    assert_non_null(stage);
    assert_true(done >= 0.0 && done <= 1.0);
    (*(int *)user)++;
}

static void a_picture_is_traced_and_written(void **state)
{
    (void)state;
    RamifyError error = {0};
    int reports = 0, samples = 0;
    RamifyRun run = {.threads = 1, .progress = count_progress, .user = &reports};
    float first[4 * WIDTH * HEIGHT], second[4 * WIDTH * HEIGHT];
    RamifyScene *scene = load();
    assert_true(ramify_render(scene, first, &samples, &run, &error));
    assert_int_equal(samples, 2);
    assert_true(reports > 0);
    run.threads = 2;
    run.progress = NULL;
    assert_true(ramify_render(scene, second, NULL, &run, &error));
    assert_memory_equal(first, second, sizeof first);
    char png[] = "/tmp/ramify_api_XXXXXX.png", exr[64];
    int descriptor = mkstemps(png, 4);
    assert_true(descriptor >= 0);
    close(descriptor);
    assert_true(ramify_write_image(scene, first, png, &error));
    snprintf(exr, sizeof exr, "%.*s.exr", (int)strlen(png) - 4, png);
    assert_true(ramify_write_image(scene, first, exr, &error));
    assert_false(ramify_write_image(scene, first, "/nope/x.png", &error));
    assert_int_equal(error.code, RAMIFY_IO);
    assert_int_equal(unlink(png) | unlink(exr), 0);
    ramify_scene_free(scene);
}

static void where_a_picture_cannot_go_is_known_before(void **state)
{
    (void)state;
    static const struct {
        const char *file;
        int32_t code;
    } files[] = {
        {"x.png", RAMIFY_OK},          {"/tmp/x.JPEG", RAMIFY_OK}, {"/tmp/x.tga", RAMIFY_BAD_INPUT},
        {"png", RAMIFY_BAD_INPUT},     {"", RAMIFY_BAD_INPUT},     {"/nope/x.png", RAMIFY_IO},
        {"/dev/null/x.exr", RAMIFY_IO}};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        RamifyError error = {0};
        assert_int_equal(ramify_image_check(files[i].file, &error), files[i].code == RAMIFY_OK);
        assert_int_equal(error.code, files[i].code);
    }
    char folder[] = "/tmp/ramify_api_XXXXXX", file[64];
    RamifyError error = {0};
    assert_non_null(mkdtemp(folder));
    snprintf(file, sizeof file, "%s/x.png", folder);
    assert_int_equal(mkdir(file, 0700), 0);
    assert_false(ramify_image_check(file, &error));
    assert_non_null(strstr(error.message, "it is not a regular file; name another"));
    assert_int_equal(rmdir(file) | rmdir(folder), 0);
}

static void a_missing_denoiser_or_configuration_is_known_before(void **state)
{
    (void)state;
    static const struct {
        const char *film, *wrong; // NULL: nothing is
        int column;
    } cases[] = {{"{denoise: true, denoiser: oidn}", "/nope/oidn.so", 33},
                 {"{denoise: true, denoiser: auto}", NULL, 0},
                 {"{denoise: true}", NULL, 0},
                 {"{denoise: false, denoiser: oidn}", NULL, 0},
                 {"{color: {config: 'ocio://nope'}}", "'ocio://nope'", 24}};
    assert_int_equal(setenv("RAMIFY_OIDN", "/nope/oidn.so", 1), 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        RamifyError error = {0};
        char yaml[200];
        snprintf(yaml, sizeof yaml, "film: %s\nobjects: [{name: a, ground: {}}]\n", cases[i].film);
        RamifyScene *scene =
            ramify_scene_load_text(yaml, strlen(yaml), "film", "", NULL, 0, &error);
        assert_non_null(scene);
        assert_int_equal(ramify_develop_check(scene, &error), !cases[i].wrong);
        if (cases[i].wrong) {
            assert_int_equal(error.code, RAMIFY_BAD_INPUT);
            assert_int_equal(error.line, 1);
            assert_int_equal(error.column, cases[i].column);
            assert_non_null(strstr(error.message, cases[i].wrong));
        }
        ramify_scene_free(scene);
    }
    unsetenv("RAMIFY_OIDN");
}

typedef struct Passes {
    int count, samples;
    bool sound;
} Passes;

static void note_pass(void *user, const RamifyFilm *film, int samples)
{
    Passes *passes = user;
    const float *taken = ramify_film_layer(film, "samples", NULL);
    passes->count++;
    passes->sound = passes->sound && samples > passes->samples && taken[0] == (float)samples;
    passes->samples = samples;
}

// The denoised layer is made once, used by all that follows and written beside the raw picture.
static void check_denoised(RamifyFilm *film, const RamifyScene *scene, const float *developed)
{
    RamifyError error = {0};
    float again[4 * WIDTH * HEIGHT];
    int channels = 0;
    assert_true(ramify_film_denoise(film, scene, NULL, &error));
    const float *clean = ramify_film_layer(film, "denoised", &channels);
    assert_non_null(clean);
    assert_int_equal(channels, 3);
    assert_true(ramify_film_develop(film, scene, true, again, NULL, &error));
    assert_memory_equal(again, developed, sizeof again);
    const float *color = ramify_film_layer(film, "color", NULL);
    assert_memory_not_equal(clean, color, 3 * sizeof(float) * WIDTH * HEIGHT);
    const struct {
        const char *layer;
        const float *wanted;
        bool denoise, there;
    } cases[] = {{"", color, true, true},
                 {"denoised", clean, true, true},
                 {"", color, false, true},
                 {"denoised", clean, false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_true(ramify_film_write(film, scene, "layers.exr", cases[i].denoise, NULL, &error));
        Image *read = image_read_layer("layers.exr", cases[i].layer, "RGB", NULL, NULL);
        assert_int_equal(read != NULL, cases[i].there);
        if (read) {
            assert_memory_equal(read->pixel, cases[i].wanted, 3 * sizeof(float) * WIDTH * HEIGHT);
        }
        image_free(read);
    }
    unlink("layers.exr");
}

static void a_film_has_layers(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int channels;
    } layers[] = {{"color", 3},  {"alpha", 1},    {"albedo", 3},  {"normal", 3},  {"depth", 1},
                  {"object", 1}, {"position", 3}, {"samples", 1}, {"variance", 1}};
    RamifyError error = {0};
    RamifyRenderInfo info = {0};
    Passes passes = {.sound = true};
    float rgba[4 * WIDTH * HEIGHT], simple[4 * WIDTH * HEIGHT];
    RamifyScene *scene = load();
    RamifyWorld *world = ramify_build(scene, NULL, &error);
    RamifyRenderer *renderer = ramify_renderer_new(world, NULL, NULL, &error);
    RamifyFilm *film = ramify_film_new(WIDTH, HEIGHT, &error);
    assert_true(renderer && film);
    assert_true(ramify_renderer_render(renderer, film, note_pass, &passes, NULL, &info, &error));
    assert_true(passes.sound && passes.count == 2 && passes.samples == 2 && info.samples == 2);
    assert_true(info.paths == 2 * WIDTH * HEIGHT && info.rays >= info.paths && info.bytes > 0);
    for (size_t i = 0; i < sizeof layers / sizeof layers[0]; i++) {
        int channels = 0;
        assert_non_null(ramify_film_layer(film, layers[i].name, &channels));
        assert_int_equal(channels, layers[i].channels);
    }
    assert_null(ramify_film_layer(film, "colour", NULL));
    assert_null(ramify_film_layer(film, "denoised", NULL));
    ramify_film_rgba(film, rgba);
    assert_true(ramify_render(scene, simple, NULL, NULL, &error)); // the same in one call
    assert_memory_equal(rgba, simple, sizeof rgba);
    assert_true(ramify_film_develop(film, scene, true, simple, NULL, &error));
    check_denoised(film, scene, simple);
    assert_true(ramify_renderer_render(renderer, film, NULL, NULL, NULL, NULL, &error));
    assert_null(ramify_film_layer(film, "denoised", NULL)); // it was of fewer samples
    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
        assert_true(simple[i] >= 0.0f && simple[i] <= 1.0f);
    }
    assert_false(ramify_film_write(film, scene, "x.tga", false, NULL, &error));
    assert_string_equal(
        error.message,
        "'x.tga' cannot be written: a picture's name must end in .png, .jpg or .exr");
    assert_false(ramify_film_write(film, scene, "/nope/x.exr", false, NULL, &error));
    assert_int_equal(error.code, RAMIFY_IO);
    assert_null(ramify_renderer_new(world, "sse9", NULL, &error));
    assert_int_equal(error.code, RAMIFY_BAD_INPUT);
    RamifyFilm *small = ramify_film_new(WIDTH, HEIGHT / 2, &error);
    assert_false(ramify_renderer_render(renderer, small, NULL, NULL, NULL, NULL, &error));
    ramify_film_free(small);
    ramify_film_free(film);
    ramify_renderer_free(renderer);
    ramify_world_free(world);
    ramify_scene_free(scene);
}

static void cancelling_ends_early(void **state)
{
    (void)state;
    RamifyError error = {0};
    const volatile int cancelled = 1;
    RamifyRun run = {.cancelled = &cancelled};
    float rgba[4 * WIDTH * HEIGHT];
    RamifyScene *scene = load();
    assert_false(ramify_render(scene, rgba, NULL, &run, &error));
    assert_int_equal(error.code, RAMIFY_CANCELLED);
    ramify_scene_free(scene);
}

static void the_schema_is_handed_out(void **state)
{
    (void)state;
    char *schema = ramify_schema(NULL);
    assert_non_null(strstr(schema, "ramify scene"));
    ramify_free(schema);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_tells_what_it_holds),
        cmocka_unit_test(infos_are_those_of_the_text),
        cmocka_unit_test(hints_know_the_nearest_word),
        cmocka_unit_test(errors_carry_their_place),
        cmocka_unit_test(growth_gives_an_out_tree),
        cmocka_unit_test(an_out_tree_survives_its_file),
        cmocka_unit_test(measures_are_those_of_the_tree),
        cmocka_unit_test(all_measures_are_those_of_each),
        cmocka_unit_test(land_has_heights),
        cmocka_unit_test(a_leaf_paints_its_veins),
        cmocka_unit_test(a_world_hands_out_its_parts),
        cmocka_unit_test(export_knows_its_formats),
        cmocka_unit_test(a_picture_is_traced_and_written),
        cmocka_unit_test(where_a_picture_cannot_go_is_known_before),
        cmocka_unit_test(a_missing_denoiser_or_configuration_is_known_before),
        cmocka_unit_test(a_film_has_layers),
        cmocka_unit_test(cancelling_ends_early),
        cmocka_unit_test(the_schema_is_handed_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
