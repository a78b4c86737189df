// A stream into a text in memory. open_memstream does not tell when a piece got lost because memory
// was short; this one does, whatever the stream's functions returned.
#ifndef RAMIFY_BASE_TEXT_STREAM_H
#define RAMIFY_BASE_TEXT_STREAM_H

#include "base/error.h"

#include <stdio.h>

typedef struct TextStream TextStream;

// Opens a stream for *file. Close it with text_stream_close, not fclose. NULL and ERROR_MEMORY when
// out of memory.
TextStream *text_stream_new(FILE **file, Error *e);

// Closes the stream; NULL is fine. The text, heap, with a NUL after its *size (may be NULL) bytes;
// NULL and ERROR_MEMORY when any of it got lost.
char *text_stream_close(TextStream *text, size_t *size, Error *e);

#endif
