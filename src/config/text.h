// Growing text on the heap.
#ifndef RAMIFY_CONFIG_TEXT_H
#define RAMIFY_CONFIG_TEXT_H

#include "base/error.h"

#include <stdint.h>

typedef struct Text {
    char *bytes; // owned; ended by NUL once something was put
    int64_t length, capacity;
    bool failed; // out of memory; e is set
    Error *e;
} Text;

// Appends formatted text, as printf.
void text_put(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The text, which the caller frees; NULL on failure.
char *text_take(Text *text);

#endif
