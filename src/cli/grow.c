// ramify grow: only the out-trees of a scene.
#include "cli/command.h"
#include "cli/land.h"

#include "base/memory.h"
#include "image/image.h"
#include "scene/build.h"
#include "scene/kind.h"
#include "tree/out_tree_io.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static void print_trees(const Scene *scene, OutTree *const *trees, double seconds)
{
    for (int i = 0; i < scene->object_count; i++) {
        if (trees[i]) {
            Aabb box = out_tree_bounds(trees[i]);
            fprintf(stderr, "%s: %" PRId64 " nodes, %.2f x %.2f x %.2f m, hash %016" PRIx64 "\n",
                    scene->objects[i].name, trees[i]->count, (double)(box.high.x - box.low.x),
                    (double)(box.high.y - box.low.y), (double)(box.high.z - box.low.z),
                    out_tree_hash(trees[i]));
        }
    }
    fprintf(stderr, "grow %.2f s, %.0f MB at most\n", seconds, (double)memory_peak() * 1e-6);
}

static void print_json(const Scene *scene, OutTree *const *trees, double seconds)
{
    const char *before = "";
    printf("{\"trees\": [");
    for (int i = 0; i < scene->object_count; i++) {
        if (trees[i]) {
            printf("%s{\"name\": ", before);
            json_print_string(scene->objects[i].name);
            printf(", \"nodes\": %" PRId64 ", \"hash\": \"%016" PRIx64 "\"}", trees[i]->count,
                   out_tree_hash(trees[i]));
            before = ", ";
        }
    }
    printf("], \"seconds\": %.3f, \"memory\": %" PRId64 "}\n", seconds, memory_peak());
}

static int count_growing(const Scene *scene)
{
    int count = 0;
    for (int i = 0; i < scene->object_count; i++) {
        count += kind_of(&scene->objects[i])->grow ? 1 : 0;
    }
    return count;
}

static bool is_picture(const char *file)
{
    return output_has_ending(file, ".png") || output_has_ending(file, ".exr");
}

// The only object whose kind makes a picture; -1 when there is none or several.
static int find_painter(const Scene *scene)
{
    int found = -1;
    for (int i = 0; i < scene->object_count; i++) {
        if (kind_of(&scene->objects[i])->paint) {
            if (found >= 0) {
                return -1;
            }
            found = i;
        }
    }
    return found;
}

static bool check_request(const Options *options, const Scene *scene, Error *e)
{
    if (count_growing(scene) == 0) {
        error_set(e, ERROR_INPUT,
                  "no object of this scene grows; it needs a tree or another growing thing");
        error_locate(e, scene->file, 0, 0);
        return false;
    }
    if (options->output && is_picture(options->output)) {
        if (land_count(scene) == 0 && find_painter(scene) < 0) {
            return error_set(e, ERROR_INPUT,
                             "--output %s; for a picture the scene must have a terrain, or exactly "
                             "one leaf (venation)",
                             options->output);
        }
    } else if (options->output && !output_has_ending(options->output, ".swc") &&
               !output_has_ending(options->output, ".json")) {
        return error_set(e, ERROR_INPUT,
                         "--output %s; its ending must be .swc, .json, .png or .exr",
                         options->output);
    }
    return !options->output || output_check(options->output, e);
}

// One tree goes to FILE.swc, several go to FILE-name.swc.
static bool write_tree(const Options *options, const Scene *scene, int index, const OutTree *tree,
                       Error *e)
{
    if (count_growing(scene) == 1) {
        return out_tree_write(tree, options->output, e);
    }
    char ending[128];
    snprintf(ending, sizeof ending, "-%s%s", scene->objects[index].name,
             output_has_ending(options->output, ".swc") ? ".swc" : ".json");
    char *file = output_with_ending(options->output, ending, e);
    bool done = file && out_tree_write(tree, file, e);
    free(file);
    return done;
}

// As large as the film: one value a pixel, 0..1, in all three channels.
static bool write_picture(const Options *options, const Scene *scene, const OutTree *tree,
                          int index, Error *e)
{
    const SceneObject *object = &scene->objects[index];
    int width = scene->film.width, height = scene->film.height;
    Image *image = image_new(width, height, 3, e);
    float *value = image ? memory_alloc((int64_t)width * height, sizeof *value, e) : NULL;
    bool done = value && kind_of(object)->paint(object, tree, width, height, value, e);
    for (int64_t i = 0; done && i < (int64_t)width * height * 3; i++) {
        image->pixel[i] = value[i / 3];
    }
    if (done && output_has_ending(options->output, ".exr")) {
        ImageLayer layer = {"", "RGB", image};
        done = image_write_exr(options->output, &layer, 1, NULL, e);
    } else if (done) {
        done = image_write_display(options->output, image, NULL, e);
    }
    free(value);
    image_free(image);
    return done;
}

static bool write_trees(const Options *options, const Scene *scene, OutTree *const *trees,
                        const Run *run, Error *e)
{
    bool done = true;
    if (options->output && is_picture(options->output) && land_count(scene) > 0) {
        return land_write(options, scene, trees, run, e);
    }
    if (options->output && is_picture(options->output)) {
        int painter = find_painter(scene);
        return write_picture(options, scene, trees[painter], painter, e);
    }
    for (int i = 0; options->output && done && i < scene->object_count; i++) {
        done = !trees[i] || write_tree(options, scene, i, trees[i], e);
    }
    return done;
}

static bool grow_scene(const Options *options, const Scene *scene, Error *e)
{
    Progress progress;
    Run run = command_run(options, &progress);
    double start = run_seconds();
    OutTree **trees = scene_grow(scene, &run, e);
    double seconds = run_seconds() - start;
    progress_end(&progress);
    if (!trees) {
        return false;
    }
    bool done = write_trees(options, scene, trees, &run, e);
    if (done && !options->quiet) {
        print_trees(scene, trees, seconds);
    }
    if (done && options->json) {
        print_json(scene, trees, seconds);
    }
    for (int i = 0; i < scene->object_count; i++) {
        out_tree_free(trees[i]);
    }
    free(trees);
    return done;
}

bool command_grow(const Options *options, Error *e)
{
    Scene *scene = command_scene(options, e);
    bool done = scene && check_request(options, scene, e) && grow_scene(options, scene, e);
    scene_free(scene);
    return done;
}
