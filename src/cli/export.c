// ramify export: a scene as another program's file.
#include "cli/command.h"

#include "scene/export_scene.h"

#include <stdio.h>

bool command_export(const Options *options, Error *e)
{
    if (!options->output) {
        return error_set(e, ERROR_INPUT,
                         "no file to write is named; add -o FILE with the ending of a format");
    }
    Scene *scene = scene_export_check(options->output, e) && output_check(options->output, e)
                       ? command_scene(options, e)
                       : NULL;
    if (!scene) {
        return false;
    }
    Progress progress;
    Run run = command_run(options, &progress);
    bool done = scene_export(scene, options->output, &run, e);
    progress_end(&progress);
    if (done && !options->quiet) {
        fprintf(stderr, "%s\n", options->output);
    }
    scene_free(scene);
    return done;
}
