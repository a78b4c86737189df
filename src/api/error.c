#include "api/handles.h"

#include "api/libraries.h"
#include "base/memory.h"
#include "config/hint.h"

#include <assimp/version.h>
#include <nlopt.h>
#include <seccomp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <yaml.h>

enum { MAX_THREADS = 1024 };

_Static_assert(sizeof((RamifyError){0}.file) == sizeof((Error){0}.file), "file names fit");
_Static_assert(sizeof((RamifyError){0}.message) == sizeof((Error){0}.message), "messages fit");
_Static_assert((int)RAMIFY_BAD_INPUT == (int)ERROR_INPUT && (int)RAMIFY_IO == (int)ERROR_IO &&
                   (int)RAMIFY_MEMORY == (int)ERROR_MEMORY &&
                   (int)RAMIFY_CANCELLED == (int)ERROR_CANCELLED &&
                   (int)RAMIFY_INTERNAL == (int)ERROR_INTERNAL &&
                   (int)RAMIFY_DIFFERS == (int)ERROR_DIFFERS,
               "codes are the same");

bool api_fail(RamifyError *out, const Error *e)
{
    if (out) {
        *out = (RamifyError){.code = (int32_t)e->code, .line = e->line, .column = e->column};
        memcpy(out->file, e->file, sizeof out->file);
        memcpy(out->message, e->message, sizeof out->message);
    }
    return false;
}

Run api_run(const RamifyRun *run)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    Run own = {.threads = count < 1 ? 1 : (int)(count > MAX_THREADS ? MAX_THREADS : count)};
    if (run) {
        own.threads = run->threads > 0 ? run->threads : own.threads;
        own.cancelled = run->cancelled;
        own.progress = run->progress;
        own.warn = run->warn;
        own.user = run->user;
    }
    return own;
}

const char *ramify_version(void)
{
    return RAMIFY_VERSION;
}

void ramify_libraries(char *text, size_t size)
{
    int major, minor, patch;
    nlopt_version(&major, &minor, &patch);
    snprintf(text, size,
             "GCC %d.%d.%d, %s, Assimp %u.%u.%u, libyaml %s, NLopt %d.%d.%d, libseccomp %d.%d.%d",
             __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__, libraries_compiled(),
             aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch(),
             yaml_get_version_string(), major, minor, patch, SCMP_VER_MAJOR, SCMP_VER_MINOR,
             SCMP_VER_MICRO);
}

static int text_size(size_t size)
{
    return size > 1 << 20 ? 1 << 20 : (int)size;
}

void ramify_error_format(const RamifyError *error, char *text, size_t size)
{
    Error e = {.code = (ErrorCode)error->code, .line = error->line, .column = error->column};
    memcpy(e.file, error->file, sizeof e.file);
    memcpy(e.message, error->message, sizeof e.message);
    error_format(&e, text, text_size(size));
}

int64_t ramify_memory_peak(void)
{
    return memory_peak();
}

void ramify_free(void *memory)
{
    free(memory);
}

int ramify_nearest(const char *word, const char *const *known, int count)
{
    return hint_nearest(word, known, count);
}

void ramify_suggest(const char *word, const char *const *known, int count, char *text, size_t size)
{
    hint_format(word, known, count, text, text_size(size));
}
