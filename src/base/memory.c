#include "base/memory.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
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

void *memory_alloc_wide(int64_t count, size_t size, Error *e)
{
    const size_t page = (size_t)2 << 20;
    size_t bytes = 0;
    void *wide = NULL;
    if (!byte_count(count, size, &bytes, e)) {
        return NULL;
    }
    if (bytes < 2 * page) {
        return or_error(malloc(bytes), bytes, e);
    }
    if (or_error(posix_memalign(&wide, page, bytes) == 0 ? wide : NULL, bytes, e)) {
        (void)madvise(wide, bytes, MADV_HUGEPAGE); // may be refused: only a hint
        return wide;
    }
    return NULL;
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
    memcpy(&old, array, sizeof old); // array is a T **, which the type void * cannot express
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

// The number in a file of one line; INFINITY if it holds a word ("max") or is missing.
static double number_in(const char *file)
{
    FILE *stream = fopen(file, "r");
    double number = INFINITY;
    if (stream) {
        if (fscanf(stream, "%lf", &number) != 1) {
            number = INFINITY;
        }
        fclose(stream);
    }
    return number;
}

// The lowest limit of the control groups from this one to the root. root: mount point of the
// hierarchy.
static double least_in_groups(const char *root, char *group, const char *file)
{
    char path[1024];
    double least = INFINITY;
    for (char *end = group + strlen(group); end; end = strrchr(group, '/')) {
        *end = '\0';
        snprintf(path, sizeof path, "%s%s/%s", root, group, file);
        least = fmin(least, number_in(path));
    }
    return least;
}

// For both versions of control groups: "0::/path", "4:memory:/path".
static double control_group_limit(void)
{
    char line[768];
    double least = INFINITY;
    FILE *stream = fopen("/proc/self/cgroup", "r");
    while (stream && fgets(line, sizeof line, stream)) {
        char *kinds = strchr(line, ':'), *group = kinds ? strchr(kinds + 1, ':') : NULL;
        if (!group) {
            continue;
        }
        *group++ = '\0';
        group[strcspn(group, "\n")] = '\0';
        if (kinds[1] == '\0') {
            least = fmin(least, least_in_groups("/sys/fs/cgroup", group, "memory.max"));
        } else if (strstr(kinds, "memory")) {
            least = fmin(least,
                         least_in_groups("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
        }
    }
    if (stream) {
        fclose(stream);
    }
    return least;
}

double memory_allowed(void)
{
    double least = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const __rlimit_resource_t kinds[] = {RLIMIT_AS, RLIMIT_DATA};
    for (int i = 0; i < 2; i++) {
        struct rlimit limit;
        if (getrlimit(kinds[i], &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
            least = fmin(least, (double)limit.rlim_cur);
        }
    }
    return fmin(least, control_group_limit());
}

bool memory_check(double needed, Error *e, const char *format, ...)
{
    double there = memory_allowed();
    if (needed <= there) {
        return true;
    }
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return error_set(e, ERROR_MEMORY, "%s: %.1f GB needed, %.1f GB available; use a smaller number",
                     what, needed * 1e-9, there * 1e-9);
}
