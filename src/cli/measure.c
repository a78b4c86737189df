// ramify measure: numbers about what a scene grows, or about an out-tree in a file, and whether
// they are what the scene says they must be.
#include "cli/command.h"

#include "base/measures.h"
#include "base/memory.h"
#include "mesh/height_measure.h"
#include "scene/build.h"
#include "scene/hint.h"
#include "scene/kind.h"
#include "tree/measure.h"
#include "tree/out_tree_io.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// What was measured on one object or file.
typedef struct Subject {
    const char *name, *kind;
    MeasureList list;
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
    bool has_low = !isnan(low) && low > -TARGET_NO_BOUND;
    bool has_high = !isnan(high) && high < TARGET_NO_BOUND;
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
    for (int64_t i = 0; i < subject->list.count; i++) {
        const Measure *m = &subject->list.item[i];
        char value[32], range[80];
        format_number(m->value, value, sizeof value);
        format_range(m->low, m->high, range, sizeof range);
        bool beyond = m->value < m->low || m->value > m->high;
        if (*range) {
            printf("  %-24s %12s %-8s nature %s%s\n", m->name, value, m->unit, range,
                   beyond ? "  (beyond)" : "");
        } else {
            printf("  %-24s %12s%s%s\n", m->name, value, *m->unit ? " " : "", m->unit);
        }
    }
}

static void print_json_number(const char *key, double value)
{
    if (isfinite(value)) {
        printf("\"%s\": %.9g", key, value);
    } else {
        printf("\"%s\": null", key);
    }
}

static void print_json_subject(const Subject *subject)
{
    printf("{\"name\": ");
    json_print_string(subject->name);
    printf(", \"kind\": \"%s\", \"measures\": {", subject->kind);
    for (int64_t i = 0; i < subject->list.count; i++) {
        const Measure *m = &subject->list.item[i];
        printf("%s\n  \"%s\": {", i > 0 ? "," : "", m->name);
        print_json_number("value", m->value);
        printf(", \"unit\": \"%s\"", m->unit);
        if (!isnan(m->low)) {
            printf(", ");
            print_json_number("low", m->low);
        }
        if (!isnan(m->high)) {
            printf(", ");
            print_json_number("high", m->high);
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

static bool unknown_measure(const Scene *scene, const SceneTarget *target, const MeasureList *list,
                            Error *e)
{
    const char *names[128] = {NULL};
    char hint[512];
    int count = 0;
    while (count < list->count && count < 128) {
        names[count] = list->item[count].name;
        count++;
    }
    hint_format(target->measure, names, count, hint, sizeof hint);
    error_set(e, ERROR_INPUT, "targets: %s has no measure '%.60s'; %s", target->object,
              target->measure, count > 0 ? hint : "nothing of it can be measured");
    error_locate(e, scene->file, 0, 0);
    return false;
}

// The measured value of each target; false and e when there is no such measure.
static bool find_values(const Scene *scene, const Subject *subjects, int count, double *values,
                        Error *e)
{
    static const MeasureList NOTHING = {0};
    for (int i = 0; i < scene->target_count; i++) {
        const SceneTarget *target = &scene->targets[i];
        const Subject *subject = find_subject(subjects, count, target->object);
        const MeasureList *list = subject ? &subject->list : &NOTHING;
        const Measure *measure = measures_find(list, target->measure);
        if (!measure) {
            return unknown_measure(scene, target, list, e);
        }
        values[i] = measure->value;
    }
    return true;
}

// A value that could not be measured misses its target.
static bool is_met(const SceneTarget *target, double value)
{
    return value >= target->low && value <= target->high;
}

static void print_targets(const Scene *scene, const double *values)
{
    printf("%s", scene->target_count > 0 ? "targets\n" : "");
    for (int i = 0; i < scene->target_count; i++) {
        const SceneTarget *target = &scene->targets[i];
        char name[160], value[32], range[80];
        snprintf(name, sizeof name, "%s %s", target->object, target->measure);
        format_number(values[i], value, sizeof value);
        format_range(target->low, target->high, range, sizeof range);
        printf("  %-24s %12s in %s: %s\n", name, value, range,
               is_met(target, values[i]) ? "met" : "MISSED");
    }
}

static void print_json_targets(const Scene *scene, const double *values)
{
    printf(", \"targets\": [");
    for (int i = 0; i < scene->target_count; i++) {
        const SceneTarget *target = &scene->targets[i];
        printf("%s{\"object\": ", i > 0 ? ", " : "");
        json_print_string(target->object);
        printf(", \"measure\": ");
        json_print_string(target->measure);
        printf(", ");
        print_json_number("value", values[i]);
        printf(", \"met\": %s}", is_met(target, values[i]) ? "true" : "false");
    }
    printf("]");
}

static bool judge_targets(const Scene *scene, const double *values, Error *e)
{
    int missed = 0;
    for (int i = 0; i < scene->target_count; i++) {
        missed += !is_met(&scene->targets[i], values[i]);
    }
    if (missed > 0) {
        error_set(e, ERROR_DIFFERS, "%d of %d targets missed; ramify measure says which", missed,
                  scene->target_count);
        error_locate(e, scene->file, 0, 0);
    }
    return missed == 0;
}

// ---- scenes and files ----

static bool measure_objects(const Options *options, const Scene *scene, Subject *subjects,
                            int *count, Error *e)
{
    Progress progress;
    Run run = command_run(options, &progress);
    bool done = true;
    for (int i = 0; done && i < scene->object_count; i++) {
        Subject *subject = &subjects[*count];
        *subject =
            (Subject){.name = scene->objects[i].name, .kind = kind_of(&scene->objects[i])->key};
        done = scene_measure(scene, i, &run, &subject->list, e);
        *count += !done || subject->list.count > 0; // the ground and the like have no numbers
    }
    progress_end(&progress);
    return done;
}

static void print_subjects(const Options *options, const Scene *scene, const Subject *subjects,
                           int count, const double *values)
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

static bool measure_scene(const Options *options, Error *e)
{
    Scene *scene = command_scene(options, e);
    if (!scene) {
        return false;
    }
    int count = 0;
    Subject *subjects = memory_alloc_zero(scene->object_count, sizeof *subjects, e);
    double *values = memory_alloc(scene->target_count, sizeof *values, e);
    bool done = subjects && values && measure_objects(options, scene, subjects, &count, e) &&
                find_values(scene, subjects, count, values, e);
    if (done) {
        print_subjects(options, scene, subjects, count, values);
        done = judge_targets(scene, values, e);
    }
    for (int i = 0; i < count; i++) {
        measures_clear(&subjects[i].list);
    }
    free(values);
    free(subjects);
    scene_free(scene);
    return done;
}

static bool measure_swc(const Options *options, Error *e)
{
    OutTree *tree = out_tree_read_swc(options->operand, e);
    Subject subject = {.name = options->operand, .kind = "swc"};
    bool done = tree && out_tree_measure(tree, &subject.list, e);
    if (done) {
        print_subjects(options, NULL, &subject, 1, NULL);
    }
    measures_clear(&subject.list);
    out_tree_free(tree);
    return done;
}

static bool measure_asc(const Options *options, Error *e)
{
    HeightField *field = height_field_read_asc(options->operand, e);
    Subject subject = {.name = options->operand, .kind = "asc"};
    bool done = field && height_field_measure(field, 0.0, &subject.list, e);
    if (done) {
        print_subjects(options, NULL, &subject, 1, NULL);
    }
    measures_clear(&subject.list);
    height_field_free(field);
    return done;
}

bool command_measure(const Options *options, Error *e)
{
    if (output_has_ending(options->operand, ".asc")) {
        return measure_asc(options, e);
    }
    return output_has_ending(options->operand, ".swc") ? measure_swc(options, e)
                                                       : measure_scene(options, e);
}
