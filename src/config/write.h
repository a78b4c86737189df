// Structs to YAML text, by their tables: what load_document reads, it would read again from there.
#ifndef RAMIFY_CONFIG_WRITE_H
#define RAMIFY_CONFIG_WRITE_H

#include "config/load.h"

// The values that are used in place of zeros, for notes. params: a struct of the table, at the root
// or below a list or a pointer. Returns a struct like it, whose lists and pointers are not looked
// at, or NULL for no notes.
typedef const void *UsedValues(void *user, const Table *table, const void *params);

// All keys of a filled struct in block style, with "# used: ..." behind zeros that `used` (NULL =
// no notes) has other values for. files: as the loader met them. Heap text; NULL and e when memory
// is short.
char *write_struct(const Table *table, const void *params, const FileName *files, UsedValues *used,
                   void *user, Error *e);

enum { WRITE_VALUE_SIZE = 160 };

// A value that is no text, file or mapping: "3", "true", "[0, 1, 0]", an enum's name; "" for
// others.
void write_value(const Key *row, const void *member, char text[WRITE_VALUE_SIZE]);

#endif
