// Plans of batches: the options that decide on the result, as a file that is read back by the
// parser of the command line.
#include "cli/batch/plan.h"

#include "base/text_stream.h"
#include "cli/batch/folder.h"
#include "cli/command.h"
#include "cli/option_table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEADER \
    "# A batch of ramify; docs/clusters.md tells more. What is done is what is in parts/.\n"

enum { MOST_WORDS = MAX_OVERRIDES + MAX_KEYS + MAX_OPTIONS };

// Besides --output and what changes the scene.
static const char *const PLANNED[] = {"tiles", "sample-ranges", "frames",     "fps",  "turns",
                                      "spin",  "elevation",     "dolly",      "grow", "sun",
                                      "ease",  "vary-noise",    "checkpoint", "isa"};

// ---- writing

static void put_keys(FILE *stream, const RamifyKeys *keys)
{
    for (int i = 0; i < keys->count; i++) {
        fprintf(stream, "%s%.17g", i ? ":" : "", keys->value[i]);
    }
}

static void put_option(FILE *stream, const Option *option, const Options *options)
{
    const void *at = (const char *)options + option->offset;
    fprintf(stream, "--%s", option->name);
    switch (option->type) {
    case OPTION_REAL:
        fprintf(stream, "=%.17g", *(const double *)at);
        break;
    case OPTION_INT:
        fprintf(stream, "=%d", *(const int *)at);
        break;
    case OPTION_KEYS:
        fprintf(stream, "=");
        put_keys(stream, at);
        break;
    case OPTION_TEXT:
        fprintf(stream, "=%s", *(const char *const *)at);
        break;
    default: // OPTION_YES
        break;
    }
    fprintf(stream, "\n");
}

static bool is_planned(const Option *option)
{
    bool planned = false;
    for (size_t i = 0; i < sizeof PLANNED / sizeof *PLANNED; i++) {
        planned = planned || strcmp(option->name, PLANNED[i]) == 0;
    }
    return planned && option_is_of(option, COMMAND_BATCH);
}

// A picture's settings are the scene's text with all its overrides.
static void put_plan(FILE *stream, const Options *options, const char *output, const char *scene)
{
    fprintf(stream, HEADER "ramify %s\nscene %s\n--output=%s\n", ramify_version(), scene, output);
    for (int i = 0; option_table[i].name; i++) {
        if (options->given[i] && is_planned(&option_table[i])) {
            put_option(stream, &option_table[i], options);
        }
    }
    for (int i = 0; i < options->override_count; i++) {
        fprintf(stream, "--set=%s\n", options->overrides[i]);
    }
    for (int i = 0; i < options->key_count; i++) {
        fprintf(stream, "--set=%s\n", options->keys[i]);
    }
}

static bool check_lines(const Options *options, const char *output, RamifyError *e)
{
    bool several = strchr(output, '\n') || strchr(options->operand, '\n');
    for (int i = 0; i < options->override_count; i++) {
        several = several || strchr(options->overrides[i], '\n');
    }
    return !several || fail(e, RAMIFY_BAD_INPUT,
                            "a name or a value of --set has several lines; a batch's plan needs "
                            "them in one");
}

char *plan_text(const Options *given, const char *output, RamifyError *e)
{
    char scene[BATCH_PATH];
    FILE *stream;
    if (!check_lines(given, output, e) || !folder_absolute(given->operand, false, scene, e)) {
        return NULL;
    }
    TextStream *lines = text_stream_new(&stream, NULL);
    if (lines) {
        put_plan(stream, given, output, scene);
    }
    char *text = text_stream_close(lines, NULL, NULL);
    if (!text) {
        fail(e, RAMIFY_MEMORY, "out of memory");
    }
    return text;
}

// ---- reading

static bool check_version(const Batch *batch, const char *version, RamifyError *e)
{
    return strcmp(version, ramify_version()) == 0 ||
           fail(e, RAMIFY_BAD_INPUT,
                "batch '%s' was planned by ramify %.40s, this is %s; go on with that version, or "
                "plan it anew in another folder",
                batch->folder, version, ramify_version());
}

// Cuts the plan into lines and parses them as a command line.
bool plan_read(Batch *batch, RamifyError *e)
{
    int count = 0;
    const char *version = "";
    batch->text = folder_read(batch->folder, "plan", e);
    batch->words = batch->text ? allocate(MOST_WORDS + 3, sizeof *batch->words, e) : NULL;
    if (!batch->words) {
        return false;
    }
    batch->words[count++] = "ramify";
    batch->words[count++] = "batch";
    char *rest = NULL;
    for (char *line = strtok_r(batch->text, "\n", &rest); line;
         line = strtok_r(NULL, "\n", &rest)) {
        if (strncmp(line, "ramify ", 7) == 0) {
            version = line + 7;
        } else if (strncmp(line, "scene ", 6) == 0) {
            batch->scene_file = line + 6;
        } else if (line[0] != '#' && count < MOST_WORDS + 2) {
            batch->words[count++] = line;
        }
    }
    if (*version && !check_version(batch, version, e)) {
        return false;
    }
    const char *scene = batch->scene_file;
    bool parsed = options_parse(&batch->plan, count, batch->words, e);
    if (!parsed || !*version || !scene || scene[0] != '/' || !batch->plan.output) {
        RamifyError why = *e;
        return fail(e, RAMIFY_BAD_INPUT, "'%s/plan' is damaged: %.300s; plan the batch anew",
                    batch->folder,
                    parsed ? "its version, scene or output is missing" : why.message);
    }
    return true;
}
