// Compares structs filled by load_document by value, using their tables.
#ifndef RAMIFY_CONFIG_COMPARE_H
#define RAMIFY_CONFIG_COMPARE_H

#include "config/table.h"

// Is the key's value the same in two structs of its table?
bool key_equal(const Key *row, const void *a, const void *b);

// Are the values of all keys the same? but: a key to ignore; NULL = none.
bool table_equal(const Table *table, const void *a, const void *b, const char *but);

// Hash of a struct: equal structs have equal hashes, in every run of the program. hash: that of
// preceding data, or HASH_START.
uint64_t table_hash(uint64_t hash, const Table *table, const void *params, const char *but);

#endif
