// Loads values other than mappings: numbers, texts, enums, vectors, colours, files.
#ifndef RAMIFY_CONFIG_LOAD_VALUE_H
#define RAMIFY_CONFIG_LOAD_VALUE_H

#include "config/load.h"

// Stores the value of a key of the mapping in its member; false and the loader's error when it does
// not match the row.
bool load_value(const Mapping *mapping, const Key *row, const Node *given, void *member);

// "a list", "'blue'", "200", ... for messages.
const char *node_describe(const Loader *loader, const Node *node);

#endif
