#include "base/text_stream.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

struct TextStream {
    FILE *file;
    char *text; // owned
    int64_t size, capacity;
    char buffer[4096]; // the stream's: it allocates none
};

// A fopencookie writer: a short count sets the stream's error.
static ssize_t put(void *cookie, const char *bytes, size_t size)
{
    TextStream *text = cookie;
    if (!memory_reserve(&text->text, &text->capacity, text->size + (int64_t)size + 1, 1, NULL)) {
        return 0;
    }
    memcpy(text->text + text->size, bytes, size);
    text->size += (int64_t)size;
    return (ssize_t)size;
}

TextStream *text_stream_new(FILE **file, Error *e)
{
    TextStream *text = memory_alloc_zero(1, sizeof *text, e);
    if (!text) {
        return NULL;
    }
    text->file = fopencookie(text, "w", (cookie_io_functions_t){.write = put});
    if (!text->file) {
        free(text);
        error_set(e, ERROR_MEMORY, "out of memory for a text");
        return NULL;
    }
    setvbuf(text->file, text->buffer, _IOFBF, sizeof text->buffer);
    *file = text->file;
    return text;
}

char *text_stream_close(TextStream *text, size_t *size, Error *e)
{
    if (!text) {
        return NULL;
    }
    bool whole = !ferror(text->file);
    whole = fclose(text->file) == 0 && whole &&
            memory_reserve(&text->text, &text->capacity, text->size + 1, 1, NULL);
    char *result = whole ? text->text : NULL;
    if (whole) {
        result[text->size] = 0;
    } else {
        error_set(e, ERROR_MEMORY, "out of memory for a text of more than %lld bytes",
                  (long long)text->size);
        free(text->text);
    }
    if (size) {
        *size = (size_t)text->size;
    }
    free(text);
    return result;
}
