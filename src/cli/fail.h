// The commands' own errors, in the library's form.
#ifndef RAMIFY_CLI_FAIL_H
#define RAMIFY_CLI_FAIL_H

#include "ramify.h"

// Fills e with a code of ramify.h and returns false, so that callers can `return fail(...)`. The
// message says what is wrong and, after a semicolon, what would be right.
bool fail(RamifyError *e, int code, const char *format, ...) __attribute__((format(printf, 3, 4)));

// The same about a file, which is printed before the message.
bool fail_in(RamifyError *e, const char *file, int code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// Zeroed memory for count elements of size bytes, to be freed with free; NULL and e when out of
// memory.
void *allocate(int64_t count, size_t size, RamifyError *e);

// Copy of a text, to be freed with free; NULL and e when out of memory.
char *copy_text(const char *text, RamifyError *e);

#endif
