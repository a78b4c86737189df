// ramify export: a scene as another program's file.
#include "cli/command.h"

#include <stdio.h>

bool command_export(const Options *options, RamifyError *e)
{
    if (!options->output) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "no file to write is named; add -o FILE with the ending of a format");
    }
    RamifyScene *scene = ramify_export_check(options->output, e) && output_check(options->output, e)
                             ? command_scene(options, e)
                             : NULL;
    if (!scene) {
        return false;
    }
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    bool done = ramify_export(scene, options->output, &run, e);
    progress_end(&progress);
    if (done && !options->quiet) {
        fprintf(stderr, "%s\n", options->output);
    }
    ramify_scene_free(scene);
    return done;
}
