// Reads a whole text file.
#ifndef RAMIFY_CONFIG_FILE_TEXT_H
#define RAMIFY_CONFIG_FILE_TEXT_H

#include "base/error.h"

#include <stddef.h>

// The file's bytes and a NUL as heap text. what: "scene" or the like, for messages. NULL and
// ERROR_INPUT, at the file, when it is not a readable regular file of at most 16 MB.
char *file_text_read(const char *file, const char *what, size_t *length, Error *e);

#endif
