#include "config/text.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void text_put(Text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int count = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (text->failed || count < 0 ||
        !memory_reserve(&text->bytes, &text->capacity, text->length + count + 1, 1, text->e)) {
        text->failed = true;
    } else {
        text->length += vsnprintf(text->bytes + text->length, (size_t)count + 1, format, again);
    }
    va_end(again);
}

char *text_take(Text *text)
{
    if (text->failed) {
        free(text->bytes);
        text->bytes = NULL;
    }
    return text->bytes;
}
