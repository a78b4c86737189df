// Writes structs as YAML text, using their tables. load_document reads the same values back.
#ifndef RAMIFY_CONFIG_WRITE_H
#define RAMIFY_CONFIG_WRITE_H

#include "config/load.h"

// Gets the values used in place of zeros, for notes. params: a struct of the table, at the root or
// below a list or a pointer. Returns a struct of the same type, whose lists and pointers are not
// read, or NULL for no notes.
typedef const void *UsedValues(void *user, const Table *table, const void *params);

// Writes all keys of a filled struct in block style, with "# used: ..." after zeros for which
// `used` (NULL = no notes) gives another value. files: the list from the loader. Heap text; NULL
// and e when out of memory.
char *write_struct(const Table *table, const void *params, const FileName *files, UsedValues *used,
                   void *user, Error *e);

enum { WRITE_VALUE_SIZE = 160 };

// Writes a number, bool, vector or enum: "3", "true", "[0, 1, 0]", an enum's name; "" for text,
// files and mappings.
void write_value(const Key *row, const void *member, char text[WRITE_VALUE_SIZE]);

#endif
