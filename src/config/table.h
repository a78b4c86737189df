// The format of scene files: one table per mapping, one row per key. The tables alone determine how
// YAML is converted to structs (load.h), how structs are written (write.h) and compared, all
// defaults and ranges, and the contents of the JSON Schema (scene/schema_json.c) and the reference
// docs/scene.md (scene/schema_markdown.c).
#ifndef RAMIFY_CONFIG_TABLE_H
#define RAMIFY_CONFIG_TABLE_H

#include "config/node.h"

#include <stddef.h>
#include <stdint.h>

typedef enum KeyType {
    KEY_BOOL,
    KEY_INT,     // int
    KEY_INT64,   // int64_t
    KEY_UINT64,  // uint64_t
    KEY_FLOAT,   // float
    KEY_DOUBLE,  // double
    KEY_ENUM,    // a C enum, with the names in `names`
    KEY_TEXT,    // char *
    KEY_NAME,    // char[count]
    KEY_ANY,     // char *: a number, a word or a list of numbers, as YAML; a bool: is it quoted?
    KEY_FILE,    // char *: a path relative to the scene's folder; the file must exist
    KEY_VECTOR,  // float[count]
    KEY_COLOR,   // float[3]: [r, g, b] linear Rec. 709, one number for a grey, or "#rrggbb" in sRGB
    KEY_GROUP,   // a mapping in the same struct; its table's offsets are relative to this key's
    KEY_POINTER, // pointer to a separate struct; NULL when the key is omitted
    KEY_LIST     // pointer to an array of structs, and an int, their count; NULL when omitted
} KeyType;

enum {
    KEY_REQUIRED = 1,
    KEY_ABOVE = 2,       // low itself is not allowed
    KEY_BELOW = 4,       // high itself is not allowed
    KEY_INSTEAD = 8,     // alternative to another key: stored in its member, converted by a check
    KEY_SPLAT = 16,      // vectors: one number sets all components
    KEY_NO_DEFAULT = 32, // zero, or set by a check, when the file does not have the key
    KEY_OR_URI = 64      // files: "scheme://..." is no file, but the name of something else
};

// A value of a C enum and its name in the file. Lists end with {0}.
typedef struct EnumName {
    const char *name;
    int value;
} EnumName;

typedef struct Key {
    const char *key; // NULL ends a list of rows
    KeyType type;
    unsigned flags;
    size_t offset;             // in the struct
    size_t count_offset;       // of a list's count; of the bool of KEY_ANY
    size_t given_offset;       // of a bool: does the file have the key? 0 = none
    double low, high;          // range of numbers; both 0 = any finite number
    const EnumName *names;     // KEY_ENUM
    const struct Table *table; // of groups, pointers and lists
    const char *unit;
    const char *doc;
    int count;      // components of a vector; most entries of a list or of KEY_ANY; size of a name
    unsigned kinds; // bits of the kinds (see Table.kind_key) that have this key; 0 = all
} Key;

// One of several variants of a mapping. A mapping has exactly one.
typedef struct Variant {
    Key row;           // KEY_POINTER: the key that selects it, with its parameters
    const Key *beside; // keys that are allowed only with `row`; ended by {0}
} Variant;

typedef struct Mapping Mapping; // see load.h

typedef struct Table {
    const char *name; // in the JSON Schema
    const char *doc;
    const char *example; // part of a scene file that shows it, from the root; may be NULL
    size_t size;         // of the struct
    const Key *keys;
    const char *kind_key; // the enum that determines the allowed keys; NULL = none

    // Variant number index, NULL past the last one; NULL = the table has no variants.
    const Variant *(*variant)(int index);
    size_t variant_offset; // in the struct: pointer to its variant

    // Fill a zeroed struct with the defaults of a mapping. Set at most one; set none if the parent
    // mapping sets the defaults or all are 0. kind: value of kind_key; -1 when the mapping does not
    // have it (the function then sets it). given may be NULL.
    void (*defaults)(void *out);
    void (*kind_defaults)(const Node *given, int kind, void *out);

    // Checks the filled struct and may complete it; NULL = no check.
    bool (*check)(const Mapping *mapping, void *params);
} Table;

// The start of a row: key `KEY` of type `TYPE` stored in `MEMBER` of struct `STRUCT`.
#define KEY_OF(STRUCT, MEMBER, KEY, TYPE) \
    .key = (KEY), .type = (TYPE), .offset = offsetof(STRUCT, MEMBER)

// Row number index of all allowed keys: the table's own, those that select variants, those beside
// them (each key once). NULL past the last one.
const Key *table_row(const Table *table, int index);

// The row of a key; NULL when no variant has it.
const Key *table_find(const Table *table, const char *key);

// The row of a key in a list of rows that ends with {0}; NULL when there is none.
const Key *rows_find(const Key *rows, const char *key);

// Size of the key's member in bytes (of the pointer, if it is one).
size_t key_size(const Key *row);

// Calls the table's function for defaults; false when it has none.
bool table_defaults(const Table *table, const Node *given, int kind, void *out);

// The variant of a filled struct; NULL when the table has no variants.
const Variant *table_variant(const Table *table, const void *params);

// Does a mapping of this kind (-1: no kinds) have the key?
static inline bool key_in_kind(const Key *key, int kind)
{
    return kind < 0 || key->kinds == 0 || (key->kinds >> kind & 1u);
}

// NULL when there is none.
const EnumName *enum_find(const EnumName *names, const char *name);
const char *enum_name(const EnumName *names, int value);

// Access to members of structs by the types in their rows.
void *pointer_at(const void *member);
void pointer_set(void *member, const void *pointer);
int int_at(const void *member);

#endif
