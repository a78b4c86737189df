// Plans of batches: the options that decide on the result, as a file that is read back by the
// parser of the command line.
#include "cli/batch/batch.h"

#include "base/file_replace.h"
#include "cli/command.h"
#include "cli/option_table.h"
#include "cli/outputs.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

// ---- names

// The path from the root. percent: of a pattern, in which the current folder's %% are doubled.
static bool absolute(const char *path, bool pattern, char out[BATCH_PATH], RamifyError *e)
{
    char here[PATH_MAX];
    size_t used = 0;
    if (path[0] != '/') {
        if (!getcwd(here, sizeof here)) {
            return fail(e, RAMIFY_IO, "the current folder has no name: %s", strerror(errno));
        }
        for (const char *c = here; *c && used < BATCH_PATH - 4; c++) {
            out[used++] = *c;
            if (pattern && *c == '%') {
                out[used++] = '%';
            }
        }
        out[used++] = '/';
    }
    int length = snprintf(out + used, BATCH_PATH - used, "%s", path);
    return used + (size_t)length + 64 < BATCH_PATH ||
           fail(e, RAMIFY_BAD_INPUT, "'%.40s...' has too long a name; give it a shorter one", path);
}

static bool name_output(const Options *options, char output[BATCH_PATH], RamifyError *e)
{
    const char *ending = options->tiles ? ".png" : ".mp4";
    char *own = options->output ? copy_text(options->output, e)
                                : output_with_ending(file_name(options->operand), ending, e);
    bool done = own && absolute(own, !output_has_ending(own, ".mp4") && options->range, output, e);
    free(own);
    return done;
}

// "oak.batch" beside "oak.png", "oak.mp4" or "oak-%04d.png".
static bool name_folder(const Options *options, const char *output, char folder[BATCH_PATH],
                        RamifyError *e)
{
    if (options->folder) {
        return absolute(options->folder, false, folder, e);
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

// ---- reading

static char *read_text(const char *folder, const char *name, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *stream = fopen(path, "r");
    struct stat status;
    bool sized = stream && fstat(fileno(stream), &status) == 0;
    char *text = sized ? allocate((int64_t)status.st_size + 1, 1, e) : NULL;
    bool read = text && fread(text, 1, (size_t)status.st_size, stream) == (size_t)status.st_size;
    if (!sized) {
        fail(e, RAMIFY_BAD_INPUT,
             "'%s' cannot be read: %s; name the folder of a batch, as ramify batch SCENE makes it",
             path, strerror(errno));
    } else if (text && !read) {
        fail(e, RAMIFY_IO, "'%s' cannot be read whole", path);
    }
    if (stream) {
        fclose(stream);
    }
    if (!read) {
        free(text);
        return NULL;
    }
    return text;
}

static bool check_version(const Batch *batch, const char *version, RamifyError *e)
{
    return strcmp(version, ramify_version()) == 0 ||
           fail(e, RAMIFY_BAD_INPUT,
                "batch '%s' was planned by ramify %.40s, this is %s; go on with that version, or "
                "plan it anew in another folder",
                batch->folder, version, ramify_version());
}

// Cuts the plan into lines and parses them as a command line.
static bool read_plan(Batch *batch, RamifyError *e)
{
    int count = 0;
    const char *version = "";
    batch->text = read_text(batch->folder, "plan", e);
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

// Reads the scene from text, with some more overrides.
static RamifyScene *scene_of_text(const Batch *batch, const char *text, const char *const *changes,
                                  int change_count, RamifyError *e)
{
    const char *overrides[MAX_OVERRIDES + MOST_CHANGES];
    int count = batch->plan.override_count;
    char name[BATCH_PATH + 64], folder[BATCH_PATH];
    snprintf(name, sizeof name, "%s/scene.yaml", batch->folder);
    snprintf(folder, sizeof folder, "%.*s",
             (int)(strrchr(batch->scene_file, '/') - batch->scene_file), batch->scene_file);
    memcpy(overrides, batch->plan.overrides, (size_t)count * sizeof *overrides);
    for (int i = 0; i < change_count; i++) {
        overrides[count++] = changes[i];
    }
    return ramify_scene_load_text(text, strlen(text), name, *folder ? folder : "/", overrides,
                                  count, e);
}

RamifyScene *batch_scene(const Batch *batch, const char *const *changes, int count, RamifyError *e)
{
    return scene_of_text(batch, ramify_scene_text(batch->scene), changes, count, e);
}

static bool load_scene(Batch *batch, RamifyError *e)
{
    char *text = read_text(batch->folder, "scene.yaml", e);
    batch->scene = text ? scene_of_text(batch, text, NULL, 0, e) : NULL;
    free(text);
    return batch->scene;
}

Batch *batch_open(const char *folder, RamifyError *e)
{
    Batch *batch = allocate(1, sizeof *batch, e);
    bool done = batch && absolute(folder, false, batch->folder, e);
    while (done && batch->folder[1] && batch->folder[strlen(batch->folder) - 1] == '/') {
        batch->folder[strlen(batch->folder) - 1] = 0;
    }
    done = done && read_plan(batch, e) && load_scene(batch, e) &&
           batch_settle(batch, &batch->plan, batch->plan.output, e);
    if (!done) {
        batch_free(batch);
        return NULL;
    }
    return batch;
}

void batch_free(Batch *batch)
{
    if (batch) {
        ramify_scene_free(batch->scene);
        free(batch->words);
        free(batch->text);
        free(batch);
    }
}

// ---- creation

static bool make_folder(const char *folder, const char *name, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    snprintf(path, sizeof path, "%s%s%s", folder, *name ? "/" : "", name);
    struct stat status;
    return mkdir(path, 0777) == 0 ||
           (errno == EEXIST && stat(path, &status) == 0 && S_ISDIR(status.st_mode)) ||
           fail(e, RAMIFY_IO, "folder '%s' cannot be made: %s", path, strerror(errno));
}

static bool write_text(const char *folder, const char *name, const char *text, RamifyError *e)
{
    char path[BATCH_PATH + 64];
    Error why = {0};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return file_replace(path, text, strlen(text), &why) || fail(e, RAMIFY_IO, "%s", why.message);
}

// Is the file there with this text? RAMIFY_BAD_INPUT, naming the first line that differs, when it
// has another.
static bool check_same(const char *folder, const char *name, const char *text, RamifyError *e)
{
    char *old = read_text(folder, name, e);
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
    return make_folder(folder, "", e) && make_folder(folder, "parts", e) &&
           make_folder(folder, "logs", e) && write_text(folder, "scene.yaml", scene, e) &&
           write_text(folder, "plan", plan, e);
}

// The plan's text; heap. given: the options, without overrides if the scene is a picture.
static char *plan_text(const Options *given, const char *output, RamifyError *e)
{
    char scene[BATCH_PATH], *text = NULL;
    size_t size = 0;
    if (!check_lines(given, output, e) || !absolute(given->operand, false, scene, e)) {
        return NULL;
    }
    FILE *stream = open_memstream(&text, &size);
    if (stream) {
        put_plan(stream, given, output, scene);
    }
    if (!stream || fclose(stream) != 0) {
        fail(e, RAMIFY_MEMORY, "out of memory");
        free(text);
        return NULL;
    }
    return text;
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
