// Names of files.
#ifndef RAMIFY_BASE_FILE_NAME_H
#define RAMIFY_BASE_FILE_NAME_H

#include <stdbool.h>

// The name's ending from its last dot on (".png"), "" when the last part of the path has none.
const char *file_name_ending(const char *file);

// Does the name end so, after at least one other character? Upper and lower case are the same.
bool file_name_ends(const char *file, const char *ending);

#endif
