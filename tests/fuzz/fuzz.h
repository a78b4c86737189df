// What the targets of libFuzzer share: an input as a file, and a child's result that is thrown
// away.
#ifndef RAMIFY_TESTS_FUZZ_H
#define RAMIFY_TESTS_FUZZ_H

#include "base/child.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// A copy of the bytes as a text, which the caller frees.
static inline char *fuzz_text(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (!text) {
        abort();
    }
    memcpy(text, data, size);
    text[size] = 0;
    return text;
}

// A file in memory with this ending (".obj") and these bytes; the same name each time.
static inline const char *fuzz_file(const char *ending, const uint8_t *data, size_t size)
{
    static char path[64];
    snprintf(path, sizeof path, "/dev/shm/ramify-fuzz-%d%s", (int)getpid(), ending);
    FILE *stream = fopen(path, "wb");
    if (!stream || fwrite(data, 1, size, stream) != size || fclose(stream) != 0) {
        perror(path);
        abort();
    }
    return path;
}

// Runs what would run in a child, in this process.
static inline void fuzz_task(ChildTask *task, const void *job, const char *file)
{
    Error e = {0};
    ChildOutput output = {.file = memfd_create("fuzz", MFD_CLOEXEC)};
    task(job, &output, &e);
    child_output_close(&output);
    unlink(file);
}

#endif
