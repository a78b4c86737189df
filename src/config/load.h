// Converts the nodes of a document to a struct, using its table: checks keys, types, ranges,
// required keys and that files exist, and sets defaults. Each value is stored directly in its
// member.
#ifndef RAMIFY_CONFIG_LOAD_H
#define RAMIFY_CONFIG_LOAD_H

#include "config/table.h"

// A file that the scene refers to.
typedef struct FileName {
    struct FileName *next;
    const char *path; // as in the struct: joined to the scene's folder
    const char *text; // as in the scene file
} FileName;

typedef struct Loader {
    Arena *arena;       // holds the struct, everything it points to, and texts of messages
    const char *file;   // the scene's name, for errors
    const char *folder; // base of relative file paths; "" = the current folder
    bool without_files; // files that are named need not exist
    Error *e;
    FileName *files; // files found so far, the latest first
    uint64_t hash;   // of their paths, sizes and times
} Loader;

// A mapping (or list) that is being loaded: its path and its node.
struct Mapping {
    Loader *loader;
    const Mapping *up; // parent; NULL = root
    const char *key;   // in the parent mapping; the name or number of a list's entry
    const Node *given; // NULL = not in the file: all defaults
};

// Loads a document into a struct in the loader's arena; NULL and loader->e on
// failure.
void *load_document(Loader *loader, const Table *table, const Node *document);

// "camera.position", "objects.oak.tree.height"; key may be NULL. Never NULL.
const char *mapping_path(const Mapping *mapping, const char *key);

// Sets an error about the value at `at` (NULL = unknown place) and returns
// false.
bool load_fail(const Loader *loader, const Node *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// The same for a key of the mapping; the message begins with its path. The place is that of the
// key's value, or of the mapping if the file does not have the key. key: "crown.base" is the key
// `base` of the mapping `crown` below; NULL = the mapping itself.
bool mapping_fail(const Mapping *mapping, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
