// New files that take the place of others when they are whole, and leave nothing when the program
// is killed before that.
#ifndef RAMIFY_BASE_FILE_BESIDE_H
#define RAMIFY_BASE_FILE_BESIDE_H

#include "base/error.h"

#include <limits.h>
#include <stdio.h>

// What `file` stands for: where symbolic links lead, whether there is a file or not, or the name
// itself. ERROR_IO when it is there and no regular file, or when links go round or nowhere.
bool file_target(const char *file, char target[PATH_MAX], Error *e);

typedef struct FileBeside {
    int descriptor;      // open for writing; -1 = closed
    char name[PATH_MAX]; // "" = it has none yet: the system removes it with the process
} FileBeside;

// Begins a new file in the folder of target. Where the file system has files without a name it has
// none; else it is called target.ramify-PID-N.part and locked. Such files of the same target that
// nobody has locked, left by killed runs, are removed. False with errno.
bool file_beside_open(FileBeside *beside, const char *target);

// Puts the whole file in target's place, which is as it was when this fails: false with errno.
bool file_beside_publish(FileBeside *beside, const char *target);

// Closes it; what has not been published is gone. False with errno when closing tells of a failure.
bool file_beside_close(FileBeside *beside);

// A stream of a regular file, to be closed; NULL and e (ERROR_INPUT) for what cannot be opened, and
// for pipes and devices, which might never end.
FILE *file_open_regular(const char *file, Error *e);

#endif
