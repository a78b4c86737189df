// What may stand in a scene file: one table a mapping, one row a key. These tables alone say how
// YAML becomes structs (load.h), how structs are written (write.h) and compared, what the defaults
// and ranges are, and what the JSON Schema (scene/schema_json.c) and the reference docs/scene.md
// (scene/schema_markdown.c) tell.
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
    KEY_ENUM,    // a C enum, by the names of `names`
    KEY_TEXT,    // char *
    KEY_NAME,    // char[count]
    KEY_ANY,     // char *: a number, a word or a list of numbers, as YAML; and a bool: in quotes?
    KEY_FILE,    // char *: a path relative to the scene's folder; the file must exist
    KEY_VECTOR,  // float[count]
    KEY_COLOR,   // float[3]: [r, g, b] linear Rec. 709, one number for a grey, or "#rrggbb" in sRGB
    KEY_GROUP,   // a mapping whose table's offsets count from this key's offset in the same struct
    KEY_POINTER, // pointer to a struct of its own; NULL when the key is left out
    KEY_LIST     // pointer to an array of structs, and an int that counts them; NULL when left out
} KeyType;

enum {
    KEY_REQUIRED = 1,
    KEY_ABOVE = 2,      // low itself is not allowed
    KEY_BELOW = 4,      // high itself is not allowed
    KEY_INSTEAD = 8,    // in the member of another key, which a check converts it to
    KEY_SPLAT = 16,     // vectors: one number stands for all components
    KEY_NO_DEFAULT = 32 // zero, or what a check puts there, when the file does not name it
};

// A C enum's value and its name in the file. Lists of them end with {0}.
typedef struct EnumName {
    const char *name;
    int value;
} EnumName;

typedef struct Key {
    const char *key; // NULL ends a list of rows
    KeyType type;
    unsigned flags;
    size_t offset;             // in the struct
    size_t count_offset;       // of the count of a list; of the bool of KEY_ANY
    size_t given_offset;       // of a bool: does the file name the key? 0 = there is none
    double low, high;          // range of numbers; both 0 = any finite number
    const EnumName *names;     // KEY_ENUM
    const struct Table *table; // of groups, pointers and lists
    const char *unit;
    const char *doc;
    int count;      // components of a vector; most entries of a list or of KEY_ANY; size of a name
    unsigned kinds; // bits of the kinds (see Table.kind_key) that have this key; 0 = all
} Key;

// One of several things that a mapping can be. It is exactly one.
typedef struct Variant {
    Key row;           // KEY_POINTER: the key that chooses it, and its parameters
    const Key *beside; // keys that only a mapping with `row` has; ended by {0}
} Variant;

typedef struct Mapping Mapping; // see load.h

typedef struct Table {
    const char *name; // as the JSON Schema calls it
    const char *doc;
    const char *example; // a piece of a scene file that shows it, from its root; may be NULL
    size_t size;         // of the struct
    const Key *keys;
    const char *kind_key; // the enum that decides which keys there are; NULL = none

    // Variant number index, NULL from their count on; NULL = the table has none.
    const Variant *(*variant)(int index);
    size_t variant_offset; // in the struct: pointer to the variant that it is

    // Fill a zeroed struct with the defaults for a mapping: one of the two, or none where the
    // mapping's parent has them or all are 0. kind: value of kind_key, -1 when the mapping does not
    // name it (set it, then). given may be NULL.
    void (*defaults)(void *out);
    void (*kind_defaults)(const Node *given, int kind, void *out);

    // Checks the struct once it is filled, and may complete it; NULL = nothing to check.
    bool (*check)(const Mapping *mapping, void *params);
} Table;

// The start of a row: key `KEY` of type `TYPE` stored in `MEMBER` of struct `STRUCT`.
#define KEY_OF(STRUCT, MEMBER, KEY, TYPE) \
    .key = (KEY), .type = (TYPE), .offset = offsetof(STRUCT, MEMBER)

// All rows that a file may name: the table's own, those that choose variants, those beside them
// (each key once). NULL from their count on.
const Key *table_row(const Table *table, int index);

// The row of a key; NULL when no variant has it.
const Key *table_find(const Table *table, const char *key);

// The row of a key among rows that {0} ends; NULL when there is none.
const Key *rows_find(const Key *rows, const char *key);

// Bytes of the key's member (of a pointer to it, where it is one).
size_t key_size(const Key *row);

// Calls whichever function for defaults the table has; false when it has none.
bool table_defaults(const Table *table, const Node *given, int kind, void *out);

// The variant that a filled struct is; NULL where the table has none.
const Variant *table_variant(const Table *table, const void *params);

// Has a mapping of this kind (-1: no kinds) the key?
static inline bool key_in_kind(const Key *key, int kind)
{
    return kind < 0 || key->kinds == 0 || (key->kinds >> kind & 1u);
}

// NULL when there is none.
const EnumName *enum_find(const EnumName *names, const char *name);
const char *enum_name(const EnumName *names, int value);

// Members of structs whose types the rows tell.
void *pointer_at(const void *member);
void pointer_set(void *member, const void *pointer);
int int_at(const void *member);

#endif
