// Nodes to YAML text.
#ifndef RAMIFY_CONFIG_EMIT_H
#define RAMIFY_CONFIG_EMIT_H

#include "config/node.h"

typedef enum EmitMode {
    EMIT_READABLE, // for people: block style, without hidden keys
    EMIT_LOADABLE  // for libcyaml: quoted, resolved paths, hidden keys but no virtual ones
} EmitMode;

// Heap text of *length bytes, NUL after them; NULL and e when memory is short.
char *emit_yaml(const Node *root, EmitMode mode, size_t *length, Error *e);

#endif
