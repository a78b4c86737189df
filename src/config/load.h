// A complete document to C structs, through libcyaml with a schema built from the tables of spec.h.
#ifndef RAMIFY_CONFIG_LOAD_H
#define RAMIFY_CONFIG_LOAD_H

#include "config/table.h"

// Loads what resolve_document made into a struct of table->size bytes on the heap.
// ERROR_INTERNAL when libcyaml disagrees with the tables.
void *load_struct(const Table *table, const Node *document, Arena *arena, Error *e);

// Frees the texts, lists and structs below one that load_struct made, not the struct itself.
void load_clear(const Table *table, void *structure);

#endif
