// Values that are no mappings: numbers, texts, enums, vectors, colours, files.
#ifndef RAMIFY_CONFIG_RESOLVE_VALUE_H
#define RAMIFY_CONFIG_RESOLVE_VALUE_H

#include "config/resolve.h"

// The value in its one spelling; NULL and r->e when it is not what row asks for. up: the mapping.
Node *resolve_value(Resolver *r, const Key *row, const Node *given, const Path *up);

// The value that the struct at base holds; *node stays NULL for a text that is NULL or empty.
bool resolve_default(Resolver *r, const Key *row, const char *base, Node **node);

// "a list", "'blue'", "200", ... for messages.
const char *node_describe(Resolver *r, const Node *node);

#endif
