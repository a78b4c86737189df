#include "cli/command.h"

#include "base/save_clock.h"
#include "cli/interrupt.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

RamifyRun command_run(const Options *options, Progress *progress)
{
    progress_start(progress, options->quiet);
    return (RamifyRun){.threads = options->threads,
                       .cancelled = interrupt_flag(),
                       .progress = progress_report,
                       .warn = progress_warn,
                       .user = progress};
}

// The overrides of all options; list: room for MAX_OVERRIDES + MAX_KEYS. Returns their number.
static int collect_overrides(const Options *options, const char **list)
{
    int count = 0;
    for (int i = 0; i < options->override_count; i++) {
        list[count++] = options->overrides[i];
    }
    for (int i = 0; i < options->key_count; i++) {
        list[count++] = options->keys[i];
    }
    return count;
}

RamifyScene *command_scene(const Options *options, RamifyError *e)
{
    const char *overrides[MAX_OVERRIDES + MAX_KEYS];
    int count = collect_overrides(options, overrides);
    return ramify_scene_load(options->operand, overrides, count, e);
}

RamifyScene *command_settings(const Options *options, RamifyError *e)
{
    const char *overrides[MAX_OVERRIDES + MAX_KEYS];
    int count = collect_overrides(options, overrides);
    return ramify_scene_load_settings(options->operand, overrides, count, e);
}

bool command_check_memory(const Options *options, const RamifyScene *scene, RamifyError *e)
{
    return ramify_check_memory(scene, (int64_t)options->memory, 0, e);
}

double command_checkpoint(const Options *options)
{
    return option_given(options, "checkpoint") ? options->checkpoint : SAVE_CLOCK_USUAL;
}

RamifyLimits command_limits(const Options *options)
{
    return (RamifyLimits){
        .max_rmse = option_given(options, "max-rmse") ? options->max_rmse : -1.0,
        .threshold = option_given(options, "threshold") ? options->threshold : -1.0,
        .max_failing = option_given(options, "max-failing") ? options->max_failing : -1.0};
}

const char *file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool output_check(const char *file, RamifyError *e)
{
    const char *slash = strrchr(file, '/');
    size_t length = slash ? (size_t)(slash == file ? 1 : slash - file) : 1;
    char *folder = allocate((int64_t)length + 1, 1, e);
    if (!folder) {
        return false;
    }
    memcpy(folder, slash ? file : ".", length);
    struct stat status;
    bool writable = false, exists = stat(file, &status) == 0;
    if (!exists && errno == ENAMETOOLONG) {
        fail(e, RAMIFY_BAD_INPUT, "cannot write '%.40s...': %s; give it a shorter one", file,
             strerror(errno));
    } else if (exists && !S_ISREG(status.st_mode)) {
        fail(e, RAMIFY_IO, "cannot write '%s': it is not a regular file; name another", file);
    } else if (access(folder, W_OK | X_OK) != 0) {
        fail(e, RAMIFY_IO, "cannot write '%s': folder '%s': %s", file, folder, strerror(errno));
    } else {
        writable = (stat(folder, &status) == 0 && S_ISDIR(status.st_mode)) ||
                   fail(e, RAMIFY_IO, "cannot write '%s': '%s' is not a folder", file, folder);
    }
    free(folder);
    return writable;
}

static const char *find_ending(const char *file)
{
    const char *slash = strrchr(file, '/'), *dot = strrchr(file, '.');
    const char *base = slash ? slash + 1 : file;
    return dot && dot > base ? dot : file + strlen(file);
}

char *output_with_ending(const char *file, const char *ending, RamifyError *e)
{
    size_t stem = (size_t)(find_ending(file) - file), length = strlen(ending);
    char *name = allocate((int64_t)(stem + length + 1), 1, e);
    if (name) {
        memcpy(name, file, stem);
        memcpy(name + stem, ending, length + 1);
    }
    return name;
}

bool output_has_ending(const char *file, const char *ending)
{
    return strcasecmp(find_ending(file), ending) == 0;
}

int command_choice(const char *option, const char *word, const char *const known[], int count,
                   RamifyError *e)
{
    char list[256] = "";
    size_t used = 0;
    for (int i = 0; i < count; i++) {
        if (!word || strcmp(word, known[i]) == 0) {
            return i;
        }
        snprintf(list + used, sizeof list - used, "%s%s", i > 0 ? ", " : "", known[i]);
        used = strlen(list);
    }
    fail(e, RAMIFY_BAD_INPUT, "--%s %.60s; it must be one of %s", option, word, list);
    return -1;
}
