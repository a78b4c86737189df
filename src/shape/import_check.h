// Checks a mesh file before a reader opens it: it exists, has a supported format and is as long as
// its header promises. Readers crash, guess or allocate terabytes otherwise.
#ifndef RAMIFY_SHAPE_IMPORT_CHECK_H
#define RAMIFY_SHAPE_IMPORT_CHECK_H

#include "base/error.h"

// ERROR_INPUT says what is wrong, without the file's name.
bool import_check(const char *file, Error *e);

#endif
