// A batch's folder, made by the command line or found as it would be made.
#include "cli/batch/folder.h"
#include "cli/batch/plan.h"
#include "cli/command.h"
#include "cli/outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool name_output(const Options *options, char output[BATCH_PATH], RamifyError *e)
{
    const char *ending = options->tiles ? ".png" : ".mp4";
    char *own = options->output ? copy_text(options->output, e)
                                : output_with_ending(file_name(options->operand), ending, e);
    bool done =
        own && folder_absolute(own, !output_has_ending(own, ".mp4") && options->range, output, e);
    free(own);
    return done;
}

// "oak.batch" beside "oak.png", "oak.mp4" or "oak-%04d.png".
static bool name_folder(const Options *options, const char *output, char folder[BATCH_PATH],
                        RamifyError *e)
{
    if (options->folder) {
        return folder_absolute(options->folder, false, folder, e);
    }
    char *stem = output_with_ending(output, "", e);
    bool named = stem;
    if (named) {
        char *name = strrchr(stem, '/') + 1;
        size_t length = options->range ? strcspn(name, "%") : strlen(name);
        while (length > 0 && strchr("-_.", name[length - 1])) {
            length--;
        }
        const char *own = length > 0 ? "" : "frames";
        snprintf(folder, BATCH_PATH, "%.*s%s.batch", (int)(name - stem) + (int)length, stem, own);
    }
    free(stem);
    return named;
}

// ---- files

// Is the file there with this text? RAMIFY_BAD_INPUT, naming the first line that differs, when it
// has another.
static bool check_same(const char *folder, const char *name, const char *text, RamifyError *e)
{
    char *old = folder_read(folder, name, e);
    const char *a = old, *b = text;
    while (a && *a && *a == *b) {
        a++;
        b++;
    }
    bool same = a && *a == *b;
    if (a && !same) {
        while (a > old && a[-1] != '\n') {
            a--;
            b--;
        }
        fail(e, RAMIFY_BAD_INPUT,
             "'%s' is another batch: its %s has '%.*s' where this one would have '%.*s'; name "
             "another with --folder, or remove it",
             folder, name, (int)strcspn(a, "\n"), a, (int)strcspn(b, "\n"), b);
    }
    free(old);
    return same;
}

static bool write_batch(const char *folder, const char *plan, const char *scene, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    snprintf(path, sizeof path, "%s/plan", folder);
    if (access(path, F_OK) == 0) {
        return check_same(folder, "plan", plan, e) && check_same(folder, "scene.yaml", scene, e);
    }
    // the plan last: a folder with a plan is complete
    return folder_make(folder, "", e) && folder_make(folder, "parts", e) &&
           folder_make(folder, "logs", e) && folder_write(folder, "scene.yaml", scene, e) &&
           folder_write(folder, "plan", plan, e);
}

static bool check_output(const Options *options, const char *output, RamifyError *e)
{
    Outputs outputs = {0};
    Options named = *options;
    named.output = output;
    bool valid = options->range || outputs_plan(&named, &outputs, e);
    outputs_clear(&outputs);
    return valid;
}

Batch *batch_create(const Options *options, RamifyError *e)
{
    char output[BATCH_PATH], folder[BATCH_PATH];
    bool picture =
        output_has_ending(options->operand, ".exr") || output_has_ending(options->operand, ".png");
    Batch trial = {0};
    Options given = *options;
    bool done = name_output(options, output, e) && name_folder(options, output, folder, e);
    trial.scene = done ? command_scene(options, e) : NULL;
    done =
        trial.scene && batch_settle(&trial, options, output, e) && check_output(options, output, e);
    if (picture) {
        given.override_count = given.key_count = 0;
    }
    char *plan = done ? plan_text(&given, output, e) : NULL;
    done = plan && write_batch(folder, plan,
                               picture ? ramify_scene_resolved(trial.scene)
                                       : ramify_scene_text(trial.scene),
                               e);
    free(plan);
    ramify_scene_free(trial.scene);
    return done ? batch_open(folder, e) : NULL;
}
