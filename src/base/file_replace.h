// Writing a whole file so that a failure never harms an old one.
#ifndef RAMIFY_BASE_FILE_REPLACE_H
#define RAMIFY_BASE_FILE_REPLACE_H

#include "base/error.h"

#include <stddef.h>

// Writes size bytes to a new file beside `file`, brings them to the disk and renames it over
// `file` (over what it points to, if it is a symbolic link). On failure: ERROR_IO with the reason,
// `file` as it was, the new file gone. Refuses what is not a regular file.
bool file_replace(const char *file, const void *bytes, size_t size, Error *e);

// Whether it could be written, before the work that is to go there: ERROR_IO when its folder is not
// there or not to be written to, or when `file` is there and no regular file.
bool file_replace_check(const char *file, Error *e);

// Is there room in the last part of the name, with `extra` bytes that are put to it (names of files
// beside it)? ERROR_IO tells the longest.
bool file_replace_fits(const char *file, int extra, Error *e);

#endif
