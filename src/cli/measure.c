// ramify measure: prints measures of what a scene grows, or of an out-tree file, and checks them
// against the scene's targets.
#include "base/json.h"
#include "cli/command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Measures of one object or file.
typedef struct Subject {
    const char *name, *kind;
    RamifyMeasures *measures; // owned
} Subject;

// ---- one subject ----

static void format_number(double value, char *text, size_t size)
{
    if (isnan(value)) {
        snprintf(text, size, "-");
    } else if (value == floor(value) && fabs(value) < 1e15) {
        snprintf(text, size, "%.0f", value);
    } else {
        snprintf(text, size, "%.4g", value);
    }
}

// "1.8 .. 2.3", "over 3", "under 5"; empty without bounds.
static void format_range(double low, double high, char *text, size_t size)
{
    char a[32], b[32];
    format_number(low, a, sizeof a);
    format_number(high, b, sizeof b);
    bool has_low = isfinite(low);
    bool has_high = isfinite(high);
    if (has_low && has_high) {
        snprintf(text, size, "%s .. %s", a, b);
    } else if (has_low || has_high) {
        snprintf(text, size, "%s %s", has_low ? "from" : "to", has_low ? a : b);
    } else {
        *text = 0;
    }
}

static void print_table(const Subject *subject)
{
    printf("%s (%s)\n", subject->name, subject->kind);
    for (int i = 0; i < ramify_measures_count(subject->measures); i++) {
        RamifyMeasure m;
        char value[32], range[80];
        ramify_measures_get(subject->measures, i, &m);
        format_number(m.value, value, sizeof value);
        format_range(m.low, m.high, range, sizeof range);
        bool beyond = m.value < m.low || m.value > m.high;
        if (*range) {
            printf("  %-24s %12s %-8s nature %s%s\n", m.name, value, m.unit, range,
                   beyond ? "  (beyond)" : "");
        } else {
            printf("  %-24s %12s%s%s\n", m.name, value, *m.unit ? " " : "", m.unit);
        }
    }
}

static void print_json_number(const char *key, double value)
{
    printf("\"%s\": ", key);
    json_put_number(stdout, value, 9);
}

static void print_json_subject(const Subject *subject)
{
    printf("{\"name\": ");
    json_put_string(stdout, subject->name);
    printf(", \"kind\": \"%s\", \"measures\": {", subject->kind);
    for (int i = 0; i < ramify_measures_count(subject->measures); i++) {
        RamifyMeasure m;
        ramify_measures_get(subject->measures, i, &m);
        printf("%s\n  \"%s\": {", i > 0 ? "," : "", m.name);
        print_json_number("value", m.value);
        printf(", \"unit\": \"%s\"", m.unit);
        if (!isnan(m.low)) {
            printf(", ");
            print_json_number("low", m.low);
        }
        if (!isnan(m.high)) {
            printf(", ");
            print_json_number("high", m.high);
        }
        putchar('}');
    }
    printf("}}");
}

// ---- targets ----

static const Subject *find_subject(const Subject *subjects, int count, const char *name)
{
    int i = 0;
    while (i < count && strcmp(subjects[i].name, name) != 0) {
        i++;
    }
    return i < count ? &subjects[i] : NULL;
}

static bool unknown_measure(const char *file, const RamifyTarget *target,
                            const RamifyMeasures *measures, RamifyError *e)
{
    const char *names[128] = {NULL};
    char hint[512];
    int count = 0;
    while (measures && count < ramify_measures_count(measures) && count < 128) {
        RamifyMeasure measure;
        ramify_measures_get(measures, count, &measure);
        names[count++] = measure.name;
    }
    ramify_suggest(target->measure, names, count, hint, sizeof hint);
    return fail_in(e, file, RAMIFY_BAD_INPUT, "targets: %s has no measure '%.60s'; %s",
                   target->object, target->measure,
                   count > 0 ? hint : "nothing of it can be measured");
}

// Finds the measured value of each target; false and e when there is no such measure.
static bool find_values(const RamifyScene *scene, const Subject *subjects, int count,
                        double *values, RamifyError *e)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    for (int i = 0; i < info.target_count; i++) {
        RamifyTarget target;
        RamifyMeasure measure;
        ramify_scene_target(scene, i, &target);
        const Subject *subject = find_subject(subjects, count, target.object);
        int found = subject ? ramify_measures_find(subject->measures, target.measure) : -1;
        if (found < 0) {
            return unknown_measure(info.file, &target, subject ? subject->measures : NULL, e);
        }
        ramify_measures_get(subject->measures, found, &measure);
        values[i] = measure.value;
    }
    return true;
}

// Ask once, not in a loop: the scene's needs of memory are counted for it, too.
static int target_count(const RamifyScene *scene)
{
    RamifySceneInfo info;
    ramify_scene_info(scene, &info);
    return info.target_count;
}

// A missing value misses its target.
static bool is_met(const RamifyTarget *target, double value)
{
    return value >= target->low && value <= target->high;
}

static void print_targets(const RamifyScene *scene, const double *values)
{
    int count = target_count(scene);
    printf("%s", count > 0 ? "targets\n" : "");
    for (int i = 0; i < count; i++) {
        RamifyTarget target;
        char name[160], value[32], range[80];
        ramify_scene_target(scene, i, &target);
        snprintf(name, sizeof name, "%s %s", target.object, target.measure);
        format_number(values[i], value, sizeof value);
        format_range(target.low, target.high, range, sizeof range);
        printf("  %-24s %12s in %s: %s\n", name, value, range,
               is_met(&target, values[i]) ? "met" : "MISSED");
    }
}

static void print_json_targets(const RamifyScene *scene, const double *values)
{
    int count = target_count(scene);
    printf(", \"targets\": [");
    for (int i = 0; i < count; i++) {
        RamifyTarget target;
        ramify_scene_target(scene, i, &target);
        printf("%s{\"object\": ", i > 0 ? ", " : "");
        json_put_string(stdout, target.object);
        printf(", \"measure\": ");
        json_put_string(stdout, target.measure);
        printf(", ");
        print_json_number("value", values[i]);
        printf(", \"met\": %s}", is_met(&target, values[i]) ? "true" : "false");
    }
    printf("]");
}

static bool judge_targets(const RamifyScene *scene, const double *values, RamifyError *e)
{
    RamifySceneInfo info;
    int missed = 0;
    ramify_scene_info(scene, &info);
    for (int i = 0; i < info.target_count; i++) {
        RamifyTarget target;
        ramify_scene_target(scene, i, &target);
        missed += !is_met(&target, values[i]);
    }
    return missed == 0 ||
           fail_in(e, info.file, RAMIFY_DIFFERS,
                   "%d of %d targets missed; ramify measure says which", missed, info.target_count);
}

// ---- scenes and files ----

// The objects to measure, as entries of the scene's objects; NULL = out of memory. The caller
// frees.
static bool *wanted_objects(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    int count = ramify_scene_object_count(scene), targets = target_count(scene);
    bool *wanted = allocate(count, sizeof *wanted, e);
    for (int i = 0; wanted && i < count; i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        wanted[i] = !options->targets;
        for (int k = 0; k < targets && !wanted[i]; k++) {
            RamifyTarget target;
            ramify_scene_target(scene, k, &target);
            wanted[i] = strcmp(target.object, object.name) == 0;
        }
    }
    return wanted;
}

static bool measure_objects(const Options *options, const RamifyScene *scene, Subject *subjects,
                            int *count, RamifyError *e)
{
    bool *wanted = wanted_objects(options, scene, e);
    RamifyMeasures **measures =
        wanted ? allocate(ramify_scene_object_count(scene), sizeof(RamifyMeasures *), e) : NULL;
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    bool done = measures && ramify_measure_objects(scene, wanted, measures, &run, e);
    progress_end(&progress);
    for (int i = 0; done && i < ramify_scene_object_count(scene); i++) {
        RamifyObjectInfo object;
        ramify_scene_object(scene, i, &object);
        if (wanted[i] && ramify_measures_count(measures[i]) > 0) {
            subjects[(*count)++] = (Subject){object.name, object.kind, measures[i]};
        } else {
            ramify_measures_free(measures[i]);
        }
    }
    free(measures);
    free(wanted);
    return done;
}

static void print_subjects(const Options *options, const RamifyScene *scene,
                           const Subject *subjects, int count, const double *values)
{
    if (options->json) {
        printf("{\"objects\": [");
        for (int i = 0; i < count; i++) {
            printf("%s", i > 0 ? ",\n" : "");
            print_json_subject(&subjects[i]);
        }
        printf("]");
        if (scene) {
            print_json_targets(scene, values);
        }
        printf("}\n");
        return;
    }
    for (int i = 0; i < count; i++) {
        print_table(&subjects[i]);
    }
    if (scene) {
        print_targets(scene, values);
    }
}

static bool measure_scene(const Options *options, RamifyError *e)
{
    RamifyScene *scene = command_scene(options, e);
    if (!scene) {
        return false;
    }
    if (options->targets && target_count(scene) == 0) {
        ramify_scene_free(scene);
        return fail_in(e, options->operand, RAMIFY_BAD_INPUT,
                       "--targets: the scene states no targets; add a list 'targets' or leave the "
                       "option out");
    }
    int count = 0;
    Subject *subjects = allocate(ramify_scene_object_count(scene), sizeof *subjects, e);
    double *values = allocate(target_count(scene), sizeof *values, e);
    bool done = subjects && values && measure_objects(options, scene, subjects, &count, e) &&
                find_values(scene, subjects, count, values, e);
    if (done) {
        print_subjects(options, scene, subjects, count, values);
        done = judge_targets(scene, values, e);
    }
    for (int i = 0; i < count; i++) {
        ramify_measures_free(subjects[i].measures);
    }
    free(values);
    free(subjects);
    ramify_scene_free(scene);
    return done;
}

// Takes ownership of the measures; NULL = they failed.
static bool print_file(const Options *options, const char *kind, RamifyMeasures *measures)
{
    Subject subject = {options->operand, kind, measures};
    if (measures) {
        print_subjects(options, NULL, &subject, 1, NULL);
    }
    ramify_measures_free(measures);
    return measures != NULL;
}

static bool measure_tree(const Options *options, const char *kind, RamifyError *e)
{
    Progress progress;
    RamifyRun run = command_run(options, &progress);
    RamifyTree *tree = ramify_tree_read(options->operand, &run, e);
    progress_end(&progress);
    bool done = tree && print_file(options, kind, ramify_tree_measure(tree, e));
    ramify_tree_free(tree);
    return done;
}

static bool measure_asc(const Options *options, RamifyError *e)
{
    RamifyLand *land = ramify_land_read(options->operand, e);
    bool done = land && print_file(options, "asc", ramify_land_measure(land, e));
    ramify_land_free(land);
    return done;
}

bool command_measure(const Options *options, RamifyError *e)
{
    static const char *const endings[][2] = {
        {".swc", "swc"}, {".qsm", "qsm"}, {".txt", "qsm"}, {".csv", "qsm"}};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        if (output_has_ending(options->operand, endings[i][0])) {
            return measure_tree(options, endings[i][1], e);
        }
    }
    return output_has_ending(options->operand, ".asc") ? measure_asc(options, e)
                                                       : measure_scene(options, e);
}
