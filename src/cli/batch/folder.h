// Files and paths of a batch's folder.
#ifndef RAMIFY_CLI_BATCH_FOLDER_H
#define RAMIFY_CLI_BATCH_FOLDER_H

#include "cli/batch/batch.h"

// The path from the root; RAMIFY_BAD_INPUT when it is too long. pattern: of names of frames, in
// which the current folder's % are doubled.
bool folder_absolute(const char *path, bool pattern, char out[BATCH_PATH], RamifyError *e);

// Makes the folder FOLDER/NAME, or FOLDER for an empty name, unless it is there.
bool folder_make(const char *folder, const char *name, RamifyError *e);

// The text of the file FOLDER/NAME; heap. RAMIFY_BAD_INPUT when it is not there.
char *folder_read(const char *folder, const char *name, RamifyError *e);

bool folder_write(const char *folder, const char *name, const char *text, RamifyError *e);

#endif
