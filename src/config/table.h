// What may stand in a scene file: one table a mapping, one row a key. From these tables alone come
// the libcyaml schema (load.c), defaults and range checks (resolve.c), nearest-key hints, and the
// JSON Schema (schema_json.c) and the reference docs/scene.md (schema_markdown.c).
#ifndef RAMIFY_CONFIG_TABLE_H
#define RAMIFY_CONFIG_TABLE_H

#include "config/node.h"

#include <cyaml/cyaml.h>
#include <stdint.h>

typedef enum KeyType {
    KEY_BOOL,
    KEY_INT,     // int
    KEY_INT64,   // int64_t
    KEY_UINT64,  // uint64_t
    KEY_FLOAT,   // float
    KEY_DOUBLE,  // double
    KEY_ENUM,    // a C enum, by the names of `names`
    KEY_TEXT,    // char *
    KEY_NAME,    // char[count]
    KEY_ANY,     // char *: a number, a word or a list of numbers, as YAML
    KEY_FILE,    // char *: a path relative to the scene's folder; the file must exist
    KEY_VECTOR,  // float[count]
    KEY_COLOR,   // float[3]: [r, g, b] linear Rec. 709, one number for a grey, or "#rrggbb" in sRGB
    KEY_AFFINE,  // Transform: not a key of the file, but made of position, rotation and scale
    KEY_GROUP,   // a mapping whose table's offsets count from this key's offset in the same struct
    KEY_POINTER, // pointer to a struct of its own; NULL when the key is left out
    KEY_LIST     // pointer to an array of structs, and an int that counts them
} KeyType;

enum {
    KEY_REQUIRED = 1,
    KEY_ABOVE = 2,      // low itself is not allowed
    KEY_BELOW = 4,      // high itself is not allowed
    KEY_VIRTUAL = 8,    // not stored as it is: a check turns it into something else
    KEY_HIDDEN = 16,    // stored, but not a key of the file
    KEY_SPLAT = 32,     // vectors: one number stands for all components
    KEY_NO_DEFAULT = 64 // left out when the file does not name it
};

typedef struct Key {
    const char *key; // NULL ends a table
    KeyType type;
    unsigned flags;
    size_t offset, count_offset; // in the struct; of the count of a list
    double low, high;            // range of numbers; both 0 = any finite number
    const cyaml_strval_t *names; // KEY_ENUM, ended by NULL
    const struct Table *table;   // of groups, pointers and lists
    const char *unit;
    const char *doc;
    int count;      // components of a vector; most entries of a list or of KEY_ANY; size of a name
    unsigned kinds; // bits of the kinds (see Table.kind_key) that have this key; 0 = all
} Key;

typedef struct Resolver Resolver;
typedef struct Path Path;

typedef struct Table {
    const char *name; // as the JSON Schema calls it
    const char *doc;
    const char *example;  // a piece of a scene file that shows it, from its root; may be NULL
    size_t size;          // of the struct
    size_t defaults_size; // of what defaults fills, when virtual keys make it larger; 0 = size
    const Key *keys;
    const char *kind_key; // the enum that decides which keys there are; NULL = none

    // Fills a struct with the defaults for a mapping; NULL where the mapping's parent has them.
    // kind: value of kind_key, -1 when the mapping does not name it (set it, then). given may be
    // NULL.
    void (*defaults)(const Node *given, int kind, void *out);

    // Looks at the whole mapping after defaults are filled in; NULL = nothing to check.
    // May add hidden and change virtual nodes.
    bool (*check)(Resolver *resolver, const Path *path, const Node *given, Node *resolved);
} Table;

// The start of a row: key `KEY` of type `TYPE` stored in `MEMBER` of struct `STRUCT`.
#define KEY_OF(STRUCT, MEMBER, KEY, TYPE) \
    .key = (KEY), .type = (TYPE), .offset = offsetof(STRUCT, MEMBER)

// The key's row; NULL when the table has none (or it is hidden).
const Key *table_find(const Table *table, const char *key);

// Has a mapping of this kind (-1: no kinds) the key?
static inline bool key_in_kind(const Key *key, int kind)
{
    return kind < 0 || key->kinds == 0 || (key->kinds >> kind & 1u);
}

const cyaml_strval_t *enum_by_name(const cyaml_strval_t *names, const char *name);
const char *enum_name(const cyaml_strval_t *names, int64_t value);

#endif
