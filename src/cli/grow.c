// ramify grow: grows only the out-trees of a scene.
#include "base/json.h"
#include "cli/command.h"
#include "cli/land.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_trees(const RamifyScene *scene, RamifyTree *const *trees, double seconds)
{
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        if (trees[i] && ramify_tree_count(trees[i]) > 0) { // land may have no rivers
            float low[3], high[3];
            ramify_tree_bounds(trees[i], low, high);
            fprintf(stderr, "%s: %" PRId64 " nodes, %.2f x %.2f x %.2f m, hash %016" PRIx64 "\n",
                    ramify_scene_object_name(scene, i), ramify_tree_count(trees[i]),
                    (double)(high[0] - low[0]), (double)(high[1] - low[1]),
                    (double)(high[2] - low[2]), ramify_tree_hash(trees[i]));
        }
    }
    fprintf(stderr, "grow %.2f s, %.0f MB at most\n", seconds, (double)ramify_memory_peak() * 1e-6);
}

static void print_json(const RamifyScene *scene, RamifyTree *const *trees, double seconds)
{
    const char *before = "";
    printf("{\"trees\": [");
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        if (trees[i]) {
            printf("%s{\"name\": ", before);
            json_put_string(stdout, ramify_scene_object_name(scene, i));
            printf(", \"nodes\": %" PRId64 ", \"hash\": \"%016" PRIx64 "\"}",
                   ramify_tree_count(trees[i]), ramify_tree_hash(trees[i]));
            before = ", ";
        }
    }
    printf("], \"seconds\": %.3f, \"memory\": %" PRId64 "}\n", seconds, ramify_memory_peak());
}

static bool object_grows(const RamifyScene *scene, int index)
{
    RamifyObjectInfo object;
    ramify_scene_object(scene, index, &object);
    return object.grows;
}

static int count_growing(const RamifyScene *scene)
{
    int count = 0;
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        count += object_grows(scene, i);
    }
    return count;
}

static bool is_picture(const char *file)
{
    return output_has_ending(file, ".png") || output_has_ending(file, ".exr");
}

static bool is_heights(const char *file)
{
    return is_picture(file) || output_has_ending(file, ".asc") || output_has_ending(file, ".tif");
}

// Index of the only object whose kind makes a picture; -1 if there is none or several.
static int find_painter(const RamifyScene *scene)
{
    int found = -1;
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        if (object.paints) {
            if (found >= 0) {
                return -1;
            }
            found = i;
        }
    }
    return found;
}

static bool check_map(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    static const char *const maps[] = {"slope",   "aspect",         "curvature", "flow",
                                       "wetness", "river-distance", "deposit",   "wear",
                                       "bedrock", "snow",           "lava",      "scoria",
                                       "age",     "water-depth",    "sun-hours", "altitude"};
    if (!options->map) {
        return true;
    }
    char name[64]; // without the numbers that may follow it
    snprintf(name, sizeof name, "%.*s", (int)strcspn(options->map, ":"), options->map);
    const char *file = options->output;
    bool possible = file && is_heights(file) && land_count(scene) > 0;
    return command_choice("map", name, maps, (int)(sizeof maps / sizeof *maps), e) >= 0 &&
           (possible || fail(e, RAMIFY_BAD_INPUT,
                             "--map %s; it needs a scene with a terrain and --output .png, .exr, "
                             ".asc or .tif",
                             options->map));
}

static bool check_request(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    const char *file = options->output;
    if (count_growing(scene) == 0) {
        RamifySceneInfo info;
        ramify_scene_info(scene, &info);
        return fail_in(e, info.file, RAMIFY_BAD_INPUT,
                       "no object of this scene grows; it needs a tree or another growing thing");
    }
    if (!check_map(options, scene, e) || (options->tile && !land_check_tiles(options, scene, e))) {
        return false;
    }
    if (!file) {
        return true;
    }
    if (is_picture(file) && land_count(scene) == 0 && find_painter(scene) < 0) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "--output %s; for a picture the scene must have a terrain, or exactly one leaf "
                    "(venation)",
                    file);
    }
    bool heights = output_has_ending(file, ".asc") || output_has_ending(file, ".tif");
    if (heights && land_count(scene) == 0) {
        return fail(e, RAMIFY_BAD_INPUT, "--output %s; for heights the scene must have a terrain",
                    file);
    }
    if (!is_heights(file) && !output_has_ending(file, ".swc") &&
        !output_has_ending(file, ".json") && !output_has_ending(file, ".graphml")) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "--output %s; its ending must be .swc, .json, .graphml, .png, .exr, .asc or "
                    ".tif",
                    file);
    }
    return output_check(file, e);
}

// Writes a picture of the film's size.
static bool write_picture(const Options *options, const RamifyScene *scene, const RamifyTree *tree,
                          int index, RamifyError *e)
{
    int width, height;
    ramify_scene_size(scene, &width, &height);
    float *pixel = allocate((int64_t)width * height, sizeof *pixel, e);
    bool done = pixel && ramify_paint(scene, index, tree, width, height, pixel, e) &&
                ramify_paint_write(pixel, width, height, options->output, e);
    free(pixel);
    return done;
}

static bool write_trees(const Options *options, const RamifyScene *scene, RamifyTree *const *trees,
                        const RamifyRun *run, RamifyError *e)
{
    if (!options->output) {
        return true;
    }
    if (options->tile) {
        return land_write_tiles(options, scene, trees, run, e);
    }
    if (is_heights(options->output) && land_count(scene) > 0) {
        return land_write(options, scene, trees, run, e);
    }
    if (is_picture(options->output)) {
        int painter = find_painter(scene);
        return write_picture(options, scene, trees[painter], painter, e);
    }
    return ramify_export_trees(scene, (const RamifyTree *const *)trees, options->output, run, e);
}

static bool grow_all(const RamifyScene *scene, RamifyTree **trees, const RamifyRun *run,
                     RamifyError *e)
{
    bool done = true;
    for (int i = 0; done && i < ramify_scene_object_count(scene); i++) {
        if (object_grows(scene, i)) {
            trees[i] = ramify_grow(scene, i, run, e);
            done = trees[i];
        }
    }
    return done;
}

static bool grow_scene(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    RamifyTree **trees = allocate(ramify_scene_object_count(scene), sizeof(RamifyTree *), e);
    if (!trees) {
        return false;
    }
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    double start = clock_seconds();
    bool done = grow_all(scene, trees, &run, e);
    double seconds = clock_seconds() - start;
    progress_end(&progress);
    done = done && write_trees(options, scene, trees, &run, e);
    if (done && !options->quiet) {
        print_trees(scene, trees, seconds);
    }
    if (done && options->json) {
        print_json(scene, trees, seconds);
    }
    for (int i = 0; i < ramify_scene_object_count(scene); i++) {
        ramify_tree_free(trees[i]);
    }
    free(trees);
    return done;
}

bool command_grow(const Options *options, RamifyError *e)
{
    RamifyScene *scene = command_scene(options, e);
    bool done = scene && check_request(options, scene, e) && grow_scene(options, scene, e);
    ramify_scene_free(scene);
    return done;
}
