// Paths from one file to another that it names, and names of files beside it.
#ifndef RAMIFY_EXPORT_ASSET_PATH_H
#define RAMIFY_EXPORT_ASSET_PATH_H

#include "base/error.h"

// The relative path from the folder of `file`, which need not exist yet, to the existing `asset`;
// begins with ./ or ../. Heap text that the caller frees. ERROR_IO if either cannot be found.
char *asset_path(const char *file, const char *asset, Error *e);

// The name of `file` with `ending` in place of its own. Heap text that the caller frees.
char *asset_beside(const char *file, const char *ending, Error *e);

// The file for one of several objects: "out-oak.swc" of "out.swc". Heap text that the caller frees.
char *asset_of_object(const char *file, const char *object, Error *e);

#endif
