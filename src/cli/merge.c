// ramify merge: joins pictures of parts of one picture.
#include "base/json.h"
#include "cli/command.h"
#include "cli/outputs.h"

#include <stdio.h>

// The parts' scene, of which each has a crop, a range of samples or both: the whole picture.
static RamifyScene *whole_scene(const Options *options, RamifyError *e)
{
    const char *const all[] = {"film.crop=[0, 0, 1, 1]", "render.first_sample=0",
                               "render.end_sample=0"};
    return ramify_scene_load_settings(options->operand, all, 3, e);
}

static bool check_parts(const Options *options, RamifyError *e)
{
    for (int i = 0; i < options->operand_count; i++) {
        if (!output_has_ending(options->operands[i], ".exr")) {
            return fail(e, RAMIFY_BAD_INPUT,
                        "'%s' is no part; the .exr of a rendering with --crop or --sample-range is "
                        "needed",
                        options->operands[i]);
        }
    }
    return options->output || fail(e, RAMIFY_BAD_INPUT, "no output is named; add -o FILE.exr");
}

static void print_result(const Options *options, const Outputs *outputs,
                         const RamifySceneInfo *info)
{
    if (!options->quiet) {
        fprintf(stderr, "%s and %s: %d x %d pixels of %d parts\n", outputs->display, outputs->exr,
                info->width, info->height, options->operand_count);
    }
    if (options->json) {
        printf("{\"images\": [");
        json_put_string(stdout, outputs->display);
        printf(", ");
        json_put_string(stdout, outputs->exr);
        printf("], \"width\": %d, \"height\": %d, \"parts\": %d}\n", info->width, info->height,
               options->operand_count);
    }
}

static bool merge(const Options *options, const RamifyScene *scene, const Outputs *outputs,
                  RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    int64_t missing = 0;
    RamifyFilm *film =
        ramify_film_join(options->operands, options->operand_count, scene, &missing, &run, e);
    bool done = film && (missing == 0 ||
                         fail(e, RAMIFY_DIFFERS,
                              "%lld of the picture's %lld pixels are in none of the parts; nothing "
                              "is written",
                              (long long)missing, (long long)info.width * info.height));
    done = done && outputs_write(outputs, film, scene, &run, e);
    progress_end(&progress);
    if (done) {
        print_result(options, outputs, &info);
    }
    ramify_film_free(film);
    return done;
}

bool command_join(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    Outputs outputs = {0};
    bool done = outputs_plan(options, &outputs, e) && ramify_develop_check(scene, e) &&
                merge(options, scene, &outputs, e);
    outputs_clear(&outputs);
    return done;
}

bool command_merge(const Options *options, RamifyError *e)
{
    RamifyScene *scene = check_parts(options, e) ? whole_scene(options, e) : NULL;
    bool done = scene && command_join(options, scene, e);
    ramify_scene_free(scene);
    return done;
}
