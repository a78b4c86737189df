// Checked allocation: sizes are multiplied without overflow, and running out is an Error, never a
// crash.
#ifndef RAMIFY_BASE_MEMORY_H
#define RAMIFY_BASE_MEMORY_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

// count elements of size bytes, uninitialised; zero elements give a valid pointer. Release with
// free().
void *memory_alloc(int64_t count, size_t size, Error *e);

// The same, zeroed.
void *memory_alloc_zero(int64_t count, size_t size, Error *e);

// Makes *array (of *capacity elements of size bytes; NULL and 0 at first) hold at least count
// elements, growing geometrically. On failure the array is as it was.
bool memory_reserve(void *array, int64_t *capacity, int64_t count, size_t size, Error *e);

// A copy of a string on the heap (NULL gives NULL).
char *memory_copy_string(const char *text, Error *e);

// Largest resident set of this process so far, bytes.
int64_t memory_peak(void);

// Bytes of memory that this process may have at most: the machine's, or less where a limit on its
// address space (ulimit -v) or data (ulimit -d) or a control group (a container) says so.
double memory_allowed(void);

// For work whose size is known before it begins: false and ERROR_MEMORY when `needed` bytes are
// more than there may be. The message is the words of `format`, which end in what takes the memory,
// and " would take 12.3 GB, and 4.0 GB are there".
bool memory_check(double needed, Error *e, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
