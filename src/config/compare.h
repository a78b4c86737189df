// Structs that load_document filled, compared as values through their tables.
#ifndef RAMIFY_CONFIG_COMPARE_H
#define RAMIFY_CONFIG_COMPARE_H

#include "config/table.h"

// Has the key the same value in two structs of its table?
bool key_equal(const Key *row, const void *a, const void *b);

// Have all keys? but: a key that does not count; NULL = none.
bool table_equal(const Table *table, const void *a, const void *b, const char *but);

// The same number for equal structs, in every run of the program. hash: of what comes before, or
// HASH_START.
uint64_t table_hash(uint64_t hash, const Table *table, const void *params, const char *but);

#endif
