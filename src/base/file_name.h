// File name extensions.
#ifndef RAMIFY_BASE_FILE_NAME_H
#define RAMIFY_BASE_FILE_NAME_H

#include <stdbool.h>

// The extension from the last dot on (".png"), "" if the last part of the path has none.
const char *file_name_ending(const char *file);

// Whether the name has this extension after at least one other character, ignoring case.
bool file_name_ends(const char *file, const char *ending);

#endif
