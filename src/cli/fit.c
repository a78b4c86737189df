// ramify fit: finds parameters with which a scene meets its targets, and prints the way.
#include "base/json.h"
#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_COLUMN = 10, MOST_COLUMN = 20 };

// The work, for the callback that prints a line of the table.
typedef struct Table {
    const RamifyScene *scene;
    const RamifyRange *ranges;
    int range_count, target_count;
    Progress *progress;
    bool silent; // JSON follows at the end
} Table;

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

// ---- the table

static const char *path_end(const char *path)
{
    const char *end = path + strlen(path);
    bool is_number = true; // of a list's entry, which tells nothing alone
    while (end > path && (end[-1] != '.' || is_number)) {
        end--;
        is_number = is_number && (*end == '.' || (*end >= '0' && *end <= '9'));
    }
    return end;
}

static int column_width(const char *title)
{
    int length = (int)strlen(title);
    return length < LEAST_COLUMN ? LEAST_COLUMN : (length > MOST_COLUMN ? MOST_COLUMN : length);
}

static void print_title(const char *title)
{
    printf("  %*.*s", column_width(title), MOST_COLUMN, title);
}

static void print_value(const char *title, double value)
{
    if (isfinite(value)) {
        printf("  %*.6g", column_width(title), value);
    } else {
        printf("  %*s", column_width(title), "-");
    }
}

static RamifyTarget target_at(const Table *table, int index)
{
    RamifyTarget target;
    ramify_scene_target(table->scene, index, &target);
    return target;
}

static void print_head(const Table *table)
{
    for (int i = 0; i < table->range_count; i++) {
        const RamifyRange *range = &table->ranges[i];
        printf("vary    %s in %.9g .. %.9g%s\n", range->path, range->low, range->high,
               range->logarithmic ? ", logarithmic" : "");
    }
    for (int i = 0; i < table->target_count; i++) {
        RamifyTarget target = target_at(table, i);
        printf("target  %s %s in %.9g .. %.9g\n", target.object, target.measure, target.low,
               target.high);
    }
    printf("   no     misfit");
    for (int i = 0; i < table->range_count; i++) {
        print_title(path_end(table->ranges[i].path));
    }
    for (int i = 0; i < table->target_count; i++) {
        print_title(target_at(table, i).measure);
    }
    printf("\n");
}

static void print_line(const Table *table, const RamifyFit *fit, int index, bool best)
{
    RamifyEvaluation step;
    ramify_fit_evaluation(fit, index, &step);
    printf("%c%4d", best ? '*' : ' ', index + 1);
    print_value("", step.misfit);
    for (int i = 0; i < table->range_count; i++) {
        print_value(path_end(table->ranges[i].path), step.parameters[i]);
    }
    for (int i = 0; !step.failure && i < table->target_count; i++) {
        print_value(target_at(table, i).measure, step.measures[i]);
    }
    printf("%s%s\n", step.failure ? "  " : "", step.failure ? step.failure : "");
}

static void evaluated(void *user, const RamifyFit *fit)
{
    const Table *table = user;
    RamifyFitInfo info;
    ramify_fit_info(fit, &info);
    if (table->silent) {
        return;
    }
    progress_end(table->progress);
    if (info.evaluation_count == 1) {
        print_head(table);
    }
    print_line(table, fit, info.evaluation_count - 1, info.best == info.evaluation_count - 1);
    fflush(stdout);
}

static void print_best(const Table *table, const RamifyFit *fit)
{
    RamifyFitInfo info;
    RamifyEvaluation best;
    ramify_fit_info(fit, &info);
    ramify_fit_evaluation(fit, info.best, &best);
    printf("best    evaluation %d, misfit %.6g:", info.best + 1, best.misfit);
    for (int i = 0; i < table->range_count; i++) {
        printf(" --set %s=%.9g", table->ranges[i].path, best.parameters[i]);
    }
    printf("\n");
}

// ---- JSON

static void print_json_number(double value)
{
    if (isfinite(value)) {
        printf("%.9g", value);
    } else {
        printf("null");
    }
}

static void print_json_numbers(const char *key, const double *value, int count)
{
    printf("\"%s\": [", key);
    for (int i = 0; i < count; i++) {
        printf("%s", i > 0 ? ", " : "");
        print_json_number(value[i]);
    }
    printf("]");
}

static void print_json_terms(const Table *table, const RamifyEvaluation *best)
{
    printf("\"parameters\": [");
    for (int i = 0; i < table->range_count; i++) {
        const RamifyRange *range = &table->ranges[i];
        printf("%s\n  {\"path\": ", i > 0 ? "," : "");
        json_put_string(stdout, range->path);
        printf(", \"low\": %.9g, \"high\": %.9g, \"value\": %.9g}", range->low, range->high,
               best->parameters[i]);
    }
    printf("],\n\"targets\": [");
    for (int i = 0; i < table->target_count; i++) {
        RamifyTarget target = target_at(table, i);
        double value = best->measures[i];
        printf("%s\n  {\"object\": ", i > 0 ? "," : "");
        json_put_string(stdout, target.object);
        printf(", \"measure\": ");
        json_put_string(stdout, target.measure);
        printf(", \"low\": ");
        print_json_number(target.low);
        printf(", \"high\": ");
        print_json_number(target.high);
        printf(", \"value\": ");
        print_json_number(value);
        printf(", \"met\": %s}", value >= target.low && value <= target.high ? "true" : "false");
    }
    printf("]");
}

static void print_json(const Table *table, const RamifyFit *fit)
{
    RamifyFitInfo info;
    RamifyEvaluation step;
    ramify_fit_info(fit, &info);
    ramify_fit_evaluation(fit, info.best, &step);
    printf("{\"met\": %s, \"best\": %d,\n", info.met ? "true" : "false", info.best + 1);
    print_json_terms(table, &step);
    printf(",\n\"evaluations\": [");
    for (int i = 0; i < info.evaluation_count; i++) {
        ramify_fit_evaluation(fit, i, &step);
        printf("%s\n  {\"misfit\": ", i > 0 ? "," : "");
        print_json_number(step.misfit);
        printf(", ");
        print_json_numbers("parameters", step.parameters, table->range_count);
        printf(", ");
        print_json_numbers("measures", step.measures, table->target_count);
        if (step.failure) {
            printf(", \"failure\": ");
            json_put_string(stdout, step.failure);
        }
        printf("}");
    }
    printf("]}\n");
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

static bool fit_scene(const Options *options, const RamifyScene *scene, const RamifyRange *ranges,
                      RamifyError *e)
{
    Progress progress;
    RamifySceneInfo info;
    RamifyRun run = command_run(options, &progress);
    ramify_scene_info(scene, &info);
    Table table = {.scene = scene,
                   .ranges = ranges,
                   .range_count = options->vary_count,
                   .target_count = info.target_count,
                   .progress = &progress,
                   .silent = options->json};
    bool all = options->until && strcmp(options->until, "evaluations") == 0;
    RamifyFitOptions how = {.ranges = ranges,
                            .range_count = options->vary_count,
                            .evaluations = options->evaluations,
                            .until = all ? RAMIFY_UNTIL_EVALUATIONS : RAMIFY_UNTIL_TARGETS,
                            .evaluated = evaluated,
                            .user = &table};
    RamifyFit *fit = ramify_fit(scene, &how, &run, e);
    progress_end(&progress);
    bool done = fit && write_outputs(options, fit, e);
    if (done && options->json) {
        print_json(&table, fit);
    } else if (done) {
        print_best(&table, fit);
    }
    done = done && judge(options, fit, e);
    ramify_fit_free(fit);
    return done;
}

static bool check_until(const Options *options, RamifyError *e)
{
    const char *until = options->until ? options->until : "targets";
    return strcmp(until, "targets") == 0 || strcmp(until, "evaluations") == 0 ||
           fail(e, RAMIFY_BAD_INPUT, "--until %.60s; it must be targets or evaluations", until);
}

bool command_fit(const Options *options, RamifyError *e)
{
    RamifyRange *ranges = check_until(options, e) ? read_ranges(options, e) : NULL;
    RamifyScene *scene = ranges ? command_scene(options, e) : NULL;
    bool done = scene && check_outputs(options, scene, e) && fit_scene(options, scene, ranges, e);
    ramify_scene_free(scene);
    free_ranges(ranges, options->vary_count);
    return done;
}
