// Checks a document against the tables of spec.h and completes it: known keys, types, ranges,
// required keys, files that must exist; numbers in one spelling, defaults filled in.
#ifndef RAMIFY_CONFIG_RESOLVE_H
#define RAMIFY_CONFIG_RESOLVE_H

#include "config/table.h"

struct Resolver {
    Arena *arena;
    const char *file;   // the scene's name, for errors
    const char *folder; // files named in the scene are relative to it; "" = the current one
    Error *e;
    uint64_t files; // hash of the files named so far
};

// Where a value stands, from the root down; NULL is the root.
struct Path {
    const Path *up;
    const char *key;
};

// The complete document; NULL and r->e when something is wrong.
Node *resolve_document(Resolver *r, const Table *table, const Node *document);

// "camera.position", "objects.oak.tree.height" in the arena; key may be NULL. Never NULL.
const char *resolver_path(Resolver *r, const Path *path, const char *key);

// Fills the error with a message about the value at `at` (NULL = no known place) and returns
// false.
bool resolver_fail(Resolver *r, const Node *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Makes lists of numbers out of a vector's floats; for computed nodes.
Node *resolver_number_list(Resolver *r, const float *values, int count);

#endif
