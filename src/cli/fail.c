#include "cli/fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool fail(RamifyError *e, int code, const char *format, ...)
{
    va_list arguments;
    *e = (RamifyError){.code = code};
    va_start(arguments, format);
    vsnprintf(e->message, sizeof e->message, format, arguments);
    va_end(arguments);
    return false;
}

bool fail_in(RamifyError *e, const char *file, int code, const char *format, ...)
{
    va_list arguments;
    *e = (RamifyError){.code = code};
    snprintf(e->file, sizeof e->file, "%s", file);
    va_start(arguments, format);
    vsnprintf(e->message, sizeof e->message, format, arguments);
    va_end(arguments);
    return false;
}

void *allocate(int64_t count, size_t size, RamifyError *e)
{
    void *memory = calloc(count > 0 ? (size_t)count : 1, size);
    if (!memory) {
        fail(e, RAMIFY_MEMORY, "out of memory: %lld elements of %zu bytes asked for",
             (long long)count, size);
    }
    return memory;
}

char *copy_text(const char *text, RamifyError *e)
{
    size_t bytes = strlen(text) + 1;
    char *copy = allocate((int64_t)bytes, 1, e);
    return copy ? memcpy(copy, text, bytes) : NULL;
}
