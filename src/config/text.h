// Text that grows on the heap.
#ifndef RAMIFY_CONFIG_TEXT_H
#define RAMIFY_CONFIG_TEXT_H

#include "base/error.h"

#include <stdint.h>

typedef struct Text {
    char *bytes; // owned; ended by NUL once something was put
    int64_t length, capacity;
    bool failed; // memory was short, e says so
    Error *e;
} Text;

// printf to the end of the text.
void text_put(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The text itself, for the caller to free; NULL when it failed.
char *text_take(Text *text);

#endif
