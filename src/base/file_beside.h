// Atomic replacement of files: new files get their name when they are complete and leave nothing
// behind if the program is killed before.
#ifndef RAMIFY_BASE_FILE_BESIDE_H
#define RAMIFY_BASE_FILE_BESIDE_H

#include "base/error.h"

#include <limits.h>
#include <stdio.h>

// Resolves symbolic links: the file that `file` refers to, whether it exists or not. ERROR_IO when
// it exists and is not a regular file, or when links are circular or broken.
bool file_target(const char *file, char target[PATH_MAX], Error *e);

typedef struct FileBeside {
    int descriptor;      // open for writing; -1 = closed
    char name[PATH_MAX]; // "" = unnamed: the system removes it with the process
} FileBeside;

// Creates a new file in the folder of target: unnamed if the file system supports it, else named
// target.ramify-PID-N.part and locked. Removes unlocked files of that kind for the same target,
// left by killed processes. False with errno.
bool file_beside_open(FileBeside *beside, const char *target);

// Replaces target by the complete file; on failure target is unchanged. False with errno.
bool file_beside_publish(FileBeside *beside, const char *target);

// Closes the file and discards it unless published. False with errno when closing reports a
// failure.
bool file_beside_close(FileBeside *beside);

// Opens a regular file for reading, to be closed by the caller; NULL and e (ERROR_INPUT) when it
// cannot be opened, or is a pipe or device, which may never end.
FILE *file_open_regular(const char *file, Error *e);

#endif
