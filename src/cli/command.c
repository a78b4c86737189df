#include "cli/command.h"

#include "cli/interrupt.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
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

// The options that stand for keys of the scene, as overrides, so that they show in the settings
// that pictures carry.
typedef struct KeyOptions {
    char text[16][160];
    int count;
} KeyOptions;

static void add_key(KeyOptions *keys, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void add_key(KeyOptions *keys, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(keys->text[keys->count++], sizeof keys->text[0], format, arguments);
    va_end(arguments);
}

static void add_keys(KeyOptions *keys, const Options *o)
{
    if (o->samples > 0) {
        add_key(keys, "render.samples=%d", o->samples);
    }
    if (o->size[0] > 0) {
        add_key(keys, "film.width=%d", o->size[0]);
        add_key(keys, "film.height=%d", o->size[1]);
    }
    if (o->seconds >= 0.0) {
        add_key(keys, "render.seconds=%.17g", o->seconds);
    }
    if (o->noise >= 0.0) {
        add_key(keys, "render.noise=%.17g", o->noise);
    }
    if (!isnan(o->exposure)) {
        add_key(keys, "film.exposure=%.17g", o->exposure);
    }
    if (o->grow_to >= 0.0) {
        add_key(keys, "grow_to=%.17g", o->grow_to);
    }
    if (o->crop[0] >= 0.0f) {
        add_key(keys, "film.crop=[%.9g, %.9g, %.9g, %.9g]", (double)o->crop[0], (double)o->crop[1],
                (double)o->crop[2], (double)o->crop[3]);
    }
    if (o->denoise >= 0) {
        add_key(keys, "film.denoise=%s", o->denoise ? "true" : "false");
    }
}

RamifyScene *command_scene(const Options *options, RamifyError *e)
{
    KeyOptions keys = {.count = 0};
    const char *overrides[MAX_OVERRIDES + 16];
    int count = 0;
    add_keys(&keys, options);
    for (int i = 0; i < options->override_count; i++) {
        overrides[count++] = options->overrides[i];
    }
    for (int i = 0; i < keys.count; i++) {
        overrides[count++] = keys.text[i];
    }
    return ramify_scene_load(options->operand, overrides, count, e);
}

const char *file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool output_check(const char *file, RamifyError *e)
{
    struct stat status;
    if (stat(file, &status) == 0 && !S_ISREG(status.st_mode)) {
        return fail(e, RAMIFY_IO, "cannot write '%s': it is no regular file; name another", file);
    }
    const char *slash = strrchr(file, '/');
    size_t length = slash ? (size_t)(slash == file ? 1 : slash - file) : 1;
    char *folder = allocate((int64_t)length + 1, 1, e);
    if (!folder) {
        return false;
    }
    memcpy(folder, slash ? file : ".", length);
    bool writable = access(folder, W_OK | X_OK) == 0;
    if (!writable) {
        fail(e, RAMIFY_IO, "cannot write '%s': folder '%s': %s", file, folder, strerror(errno));
    } else if (stat(folder, &status) != 0 || !S_ISDIR(status.st_mode)) {
        writable = fail(e, RAMIFY_IO, "cannot write '%s': '%s' is no folder", file, folder);
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

void json_print_string(const char *text)
{
    putchar('"');
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 0x20) {
            printf("\\u%04x", c);
        } else {
            if (c == '"' || c == '\\') {
                putchar('\\');
            }
            putchar(c);
        }
    }
    putchar('"');
}
