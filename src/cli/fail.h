// The command's own errors, in the library's form.
#ifndef RAMIFY_CLI_FAIL_H
#define RAMIFY_CLI_FAIL_H

#include "ramify.h"

// Fills e with a code of ramify.h and returns false, so that callers can `return fail(...)`. The
// message says what is wrong and, after a semicolon, what would be right.
bool fail(RamifyError *e, int code, const char *format, ...) __attribute__((format(printf, 3, 4)));

// The same about a file, which the report names first.
bool fail_in(RamifyError *e, const char *file, int code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// Zeroed memory for count elements of size bytes (give it to free); NULL and e when it is short.
void *allocate(int64_t count, size_t size, RamifyError *e);

// A copy of a text, give it to free; NULL and e when memory is short.
char *copy_text(const char *text, RamifyError *e);

#endif
