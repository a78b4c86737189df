// What can be told about a mesh file before a reader takes it on: that it is there, of a kind we
// read, and as long as its own header promises. Readers crash, guess or ask for terabytes where
// these do not hold.
#ifndef RAMIFY_SHAPE_IMPORT_CHECK_H
#define RAMIFY_SHAPE_IMPORT_CHECK_H

#include "base/error.h"

// ERROR_INPUT says what is wrong, without the file's name.
bool import_check(const char *file, Error *e);

#endif
