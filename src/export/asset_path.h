// How a file names another one that it needs.
#ifndef RAMIFY_EXPORT_ASSET_PATH_H
#define RAMIFY_EXPORT_ASSET_PATH_H

#include "base/error.h"

// The way from the folder of `file`, which need not exist yet, to the existing `asset`: it begins
// with ./ or ../. Heap text that the caller frees. ERROR_IO when either cannot be found.
char *asset_path(const char *file, const char *asset, Error *e);

// The name of a file beside `file`: its name without the ending, and `ending` instead. Heap text.
char *asset_beside(const char *file, const char *ending, Error *e);

// The file of one of several objects that get one each: "out-oak.swc" of "out.swc". Heap text.
char *asset_of_object(const char *file, const char *object, Error *e);

#endif
