// Nodes of a document to a struct, by its table: known keys, types, ranges, required keys, files
// that must exist, defaults for what is left out. Each value goes straight into its member.
#ifndef RAMIFY_CONFIG_LOAD_H
#define RAMIFY_CONFIG_LOAD_H

#include "config/table.h"

// A file that the scene names.
typedef struct FileName {
    struct FileName *next;
    const char *path; // as the struct has it: in the scene's folder
    const char *text; // as it was written
} FileName;

typedef struct Loader {
    Arena *arena;       // of the struct, all that it points to, and the texts of messages
    const char *file;   // the scene's name, for errors
    const char *folder; // files named in the scene are relative to it; "" = the current one
    Error *e;
    FileName *files; // those met so far, the last one first
    uint64_t hash;   // of their paths, sizes and times
} Loader;

// A mapping (or list) that is being loaded: where it stands and what the file gives.
struct Mapping {
    Loader *loader;
    const Mapping *up; // NULL = this is the root
    const char *key;   // in the mapping above; the name or number of a list's entry
    const Node *given; // NULL = nothing: all is default
};

// The struct that a document describes, in the loader's arena; NULL and loader->e when something is
// wrong.
void *load_document(Loader *loader, const Table *table, const Node *document);

// "camera.position", "objects.oak.tree.height"; key may be NULL. Never NULL.
const char *mapping_path(const Mapping *mapping, const char *key);

// Fills the error with a message about the value at `at` (NULL = no known place) and returns
// false.
bool load_fail(const Loader *loader, const Node *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// The same about a key of the mapping, whose path the message begins with. It points at the key's
// value, or where the file does not name it at the mapping that would hold it. key: "crown.base" is
// a key of the mapping `crown` below; NULL = the mapping itself.
bool mapping_fail(const Mapping *mapping, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
