#include "base/memory.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static bool byte_count(int64_t count, size_t size, size_t *bytes, Error *e)
{
    if (count < 0 || __builtin_mul_overflow((size_t)count, size, bytes) ||
        *bytes > (size_t)PTRDIFF_MAX) {
        error_set(e, ERROR_MEMORY, "out of memory: %lld elements of %zu bytes asked for",
                  (long long)count, size);
        return false;
    }
    if (*bytes == 0) {
        *bytes = 1;
    }
    return true;
}

static void *or_error(void *memory, size_t bytes, Error *e)
{
    if (!memory) {
        error_set(e, ERROR_MEMORY, "out of memory: %.1f MB more were needed", (double)bytes * 1e-6);
    }
    return memory;
}

void *memory_alloc(int64_t count, size_t size, Error *e)
{
    size_t bytes = 0;
    return byte_count(count, size, &bytes, e) ? or_error(malloc(bytes), bytes, e) : NULL;
}

void *memory_alloc_zero(int64_t count, size_t size, Error *e)
{
    size_t bytes = 0;
    return byte_count(count, size, &bytes, e) ? or_error(calloc(1, bytes), bytes, e) : NULL;
}

bool memory_reserve(void *array, int64_t *capacity, int64_t count, size_t size, Error *e)
{
    if (count <= *capacity) {
        return true;
    }
    int64_t wanted = *capacity + *capacity / 2 + 16;
    if (wanted < count) {
        wanted = count;
    }
    size_t bytes = 0;
    if (!byte_count(wanted, size, &bytes, e)) {
        return false;
    }
    void *old;
    memcpy(&old, array, sizeof old); // array is a T **, which void * cannot say
    void *grown = or_error(realloc(old, bytes), bytes, e);
    if (!grown) {
        return false;
    }
    memcpy(array, &grown, sizeof grown);
    *capacity = wanted;
    return true;
}

char *memory_copy_string(const char *text, Error *e)
{
    if (!text) {
        return NULL;
    }
    size_t bytes = strlen(text) + 1;
    char *copy = memory_alloc((int64_t)bytes, 1, e);
    return copy ? memcpy(copy, text, bytes) : NULL;
}

int64_t memory_peak(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (int64_t)usage.ru_maxrss * 1024 : 0;
}

double memory_of_machine(void)
{
    return (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}
