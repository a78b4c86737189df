// Checked allocation: sizes are multiplied without overflow, and lack of memory is an Error, never
// a crash.
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

// As memory_alloc, for arrays of many megabytes that are read here and there: on large pages where
// the system offers them, since the search for a small one (a miss of the processor's table of
// pages) may take longer than the read.
void *memory_alloc_wide(int64_t count, size_t size, Error *e);

// Grows *array (of *capacity elements of size bytes; NULL and 0 at first) geometrically to at least
// count elements. On failure the array is unchanged.
bool memory_reserve(void *array, int64_t *capacity, int64_t count, size_t size, Error *e);

// Copy of a string on the heap (NULL gives NULL).
char *memory_copy_string(const char *text, Error *e);

// Largest resident set of this process so far, bytes.
int64_t memory_peak(void);

// Largest amount of memory that this process may use, bytes: the machine's, or less under a limit
// on address space (ulimit -v), data (ulimit -d) or a control group (container).
double memory_allowed(void);

// For work of known size: false and ERROR_MEMORY when `needed` bytes exceed memory_allowed. The
// message is `format`, which names what takes the memory, followed by ": 12.3 GB needed, 4.0 GB
// available; ...".
bool memory_check(double needed, Error *e, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
