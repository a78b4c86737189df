// Writes a whole file atomically.
#ifndef RAMIFY_BASE_FILE_REPLACE_H
#define RAMIFY_BASE_FILE_REPLACE_H

#include "base/error.h"

#include <stddef.h>

// Writes size bytes to a new file beside `file`, syncs it to disk and renames it to `file` (to its
// target, if it is a symbolic link). On failure: ERROR_IO with the reason, `file` unchanged, the
// new file removed. Refuses what is not a regular file.
bool file_replace(const char *file, const void *bytes, size_t size, Error *e);

// Checks in advance that `file` can be written: ERROR_IO when its folder is missing or not
// writable, or when `file` exists and is not a regular file.
bool file_replace_check(const char *file, Error *e);

// Checks that the last part of the name can be `extra` bytes longer (for files beside it). ERROR_IO
// gives the longest possible.
bool file_replace_fits(const char *file, int extra, Error *e);

#endif
