#include "cli/command.h"

#include "base/memory.h"
#include "cli/interrupt.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

// Processors that this process may use.
static int processor_count(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : (count > 1024 ? 1024 : (int)count);
}

Run command_run(const Options *options, Progress *progress)
{
    progress_start(progress, options->quiet);
    return (Run){.threads = options->threads > 0 ? options->threads : processor_count(),
                 .cancelled = interrupt_flag(),
                 .progress = progress_report,
                 .warn = progress_warn,
                 .user = progress};
}

Scene *command_scene(const Options *options, Error *e)
{
    Scene *scene = scene_read(options->operand, options->overrides, options->override_count, e);
    if (!scene) {
        return NULL;
    }
    if (options->samples > 0) {
        scene->render.samples = options->samples;
    }
    if (options->size[0] > 0) {
        scene->film.width = options->size[0];
        scene->film.height = options->size[1];
    }
    if (options->seconds >= 0.0) {
        scene->render.max_seconds = options->seconds;
    }
    if (options->noise >= 0.0) {
        scene->render.max_noise = (float)options->noise;
    }
    if (!isnan(options->exposure)) {
        scene->tone.exposure = (float)options->exposure;
    }
    if (options->crop[0] >= 0.0f) {
        memcpy(scene->film.crop, options->crop, sizeof scene->film.crop);
    }
    if (options->denoise >= 0) {
        scene->denoise = options->denoise == 1;
    }
    return scene;
}

bool output_check(const char *file, Error *e)
{
    struct stat status;
    if (stat(file, &status) == 0 && !S_ISREG(status.st_mode)) {
        return error_set(e, ERROR_IO, "cannot write '%s': it is no regular file; name another",
                         file);
    }
    const char *slash = strrchr(file, '/');
    char *folder = memory_copy_string(slash ? file : ".", e);
    if (!folder) {
        return false;
    }
    if (slash) {
        folder[slash == file ? 1 : slash - file] = 0;
    }
    bool writable = access(folder, W_OK | X_OK) == 0;
    if (!writable) {
        error_set(e, ERROR_IO, "cannot write '%s': folder '%s': %s", file, folder, strerror(errno));
    } else if (stat(folder, &status) != 0 || !S_ISDIR(status.st_mode)) {
        writable = error_set(e, ERROR_IO, "cannot write '%s': '%s' is no folder", file, folder);
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

char *output_with_ending(const char *file, const char *ending, Error *e)
{
    size_t stem = (size_t)(find_ending(file) - file), length = strlen(ending);
    char *name = memory_alloc((int64_t)(stem + length + 1), 1, e);
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
