// ramify fit: finds parameters with which a scene meets its targets.
#include "cli/command.h"
#include "cli/fit_report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The work, for the callback that prints a line of the table.
typedef struct Work {
    FitReport report;
    Progress *progress;
    bool silent; // JSON follows at the end
} Work;

// ---- ranges

// Parses "PATH=LOW:HIGH" or "PATH=LOW:HIGH:log". The path goes to the heap.
static bool read_range(const char *text, RamifyRange *range, RamifyError *e)
{
    const char *equals = strchr(text, '=');
    char *end = NULL;
    bool valid = equals && equals > text;
    if (valid) {
        range->low = strtod(equals + 1, &end);
        valid = end > equals + 1 && *end == ':';
    }
    if (valid) {
        const char *second = end + 1;
        range->high = strtod(second, &end);
        range->logarithmic = strcmp(end, ":log") == 0;
        valid = end > second && (*end == 0 || range->logarithmic);
    }
    if (!valid) {
        return fail(e, RAMIFY_BAD_INPUT,
                    "--vary %.100s; it must be PATH=LOW:HIGH or PATH=LOW:HIGH:log, as in "
                    "objects.oak.tree.height=5:20",
                    text);
    }
    char *path = copy_text(text, e);
    if (path) {
        path[equals - text] = 0;
    }
    range->path = path;
    return path;
}

static void free_ranges(RamifyRange *ranges, int count)
{
    for (int i = 0; ranges && i < count; i++) {
        free((char *)ranges[i].path);
    }
    free(ranges);
}

static RamifyRange *read_ranges(const Options *options, RamifyError *e)
{
    if (options->vary_count == 0) {
        fail(e, RAMIFY_BAD_INPUT,
             "nothing to vary; write --vary PATH=LOW:HIGH, as in --vary "
             "objects.oak.tree.height=5:20");
        return NULL;
    }
    RamifyRange *ranges = allocate(options->vary_count, sizeof *ranges, e);
    bool read = ranges;
    for (int i = 0; read && i < options->vary_count; i++) {
        read = read_range(options->varied[i], &ranges[i], e);
    }
    if (!read) {
        free_ranges(ranges, options->vary_count);
        ranges = NULL;
    }
    return ranges;
}

// ---- output

// Checks before the work that the outputs can be written, and that the scene can be read from
// there: files that it names are relative to its folder.
static bool check_outputs(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    const char *output = options->output, *picture = options->picture;
    if (picture && !output_has_ending(picture, ".svg")) {
        return fail(e, RAMIFY_BAD_INPUT, "--picture %s; its ending must be .svg", picture);
    }
    if (output && !output_has_ending(output, ".yaml")) {
        return fail(e, RAMIFY_BAD_INPUT, "--output %s; its ending must be .yaml", output);
    }
    if ((output && !output_check(output, e)) || (picture && !output_check(picture, e))) {
        return false;
    }
    char *folder = output ? copy_text(output, e) : NULL;
    if (output && !folder) {
        return false;
    }
    RamifyScene *moved = NULL;
    if (folder) {
        folder[file_name(folder) - folder] = 0;
        const char *text = ramify_scene_text(scene);
        moved = ramify_scene_load_text(text, strlen(text), output, folder, options->overrides,
                                       options->override_count, e);
    }
    bool done = !folder || moved;
    ramify_scene_free(moved);
    free(folder);
    return done;
}

static bool write_outputs(const Options *options, const RamifyFit *fit, RamifyError *e)
{
    bool whole = true;
    bool done = (!options->output || ramify_fit_write(fit, options->output, &whole, e)) &&
                (!options->picture || ramify_fit_draw(fit, options->picture, e));
    if (done && !whole && !options->quiet) {
        fprintf(stderr,
                "warning: %s has all values written out and no comments: the scene's text could "
                "not be edited in place\n",
                options->output);
    }
    return done;
}

// What the end of the search means for the exit status.
static bool judge(const Options *options, const RamifyFit *fit, RamifyError *e)
{
    RamifyFitInfo info;
    ramify_fit_info(fit, &info);
    if (info.cancelled) {
        return fail(e, RAMIFY_CANCELLED, "interrupted after %d evaluations; %s",
                    info.evaluation_count,
                    options->output ? "the best so far is written" : "the best so far is above");
    }
    return info.met || fail_in(e, options->operand, RAMIFY_DIFFERS,
                               "no scene of %d evaluations meets all targets; widen the ranges of "
                               "--vary, vary more numbers or raise --evaluations",
                               info.evaluation_count);
}

static void evaluated(void *user, const RamifyFit *fit)
{
    const Work *work = user;
    if (!work->silent) {
        progress_end(work->progress);
        fit_report_last(&work->report, fit);
    }
}

static bool fit_scene(const Options *options, const RamifyScene *scene, const RamifyRange *ranges,
                      int until, RamifyError *e)
{
    Progress progress;
    RamifySceneInfo info;
    RamifyRun run = command_run(options, &progress);
    ramify_scene_info(scene, &info);
    Work work = {.report = {.scene = scene,
                            .ranges = ranges,
                            .range_count = options->vary_count,
                            .target_count = info.target_count},
                 .progress = &progress,
                 .silent = options->json};
    RamifyFitOptions how = {.ranges = ranges,
                            .range_count = options->vary_count,
                            .evaluations = options->evaluations,
                            .until = until,
                            .evaluated = evaluated,
                            .user = &work};
    RamifyFit *fit = ramify_fit(scene, &how, &run, e);
    progress_end(&progress);
    bool done = fit && write_outputs(options, fit, e);
    if (done && options->json) {
        fit_report_json(&work.report, fit);
    } else if (done) {
        fit_report_best(&work.report, fit);
    }
    done = done && judge(options, fit, e);
    ramify_fit_free(fit);
    return done;
}

bool command_fit(const Options *options, RamifyError *e)
{
    static const char *const ends[] = {"targets", "evaluations"}; // in the order of RAMIFY_UNTIL_
    int until = command_choice("until", options->until, ends, 2, e);
    RamifyRange *ranges = until >= 0 ? read_ranges(options, e) : NULL;
    RamifyScene *scene = ranges ? command_scene(options, e) : NULL;
    bool done =
        scene && check_outputs(options, scene, e) && fit_scene(options, scene, ranges, until, e);
    ramify_scene_free(scene);
    free_ranges(ranges, options->vary_count);
    return done;
}
