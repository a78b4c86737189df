// A YAML document as a tree of nodes with their places in the file. All nodes and texts of a
// document are allocated in one arena and freed with it.
#ifndef RAMIFY_CONFIG_NODE_H
#define RAMIFY_CONFIG_NODE_H

#include "base/error.h"

#include <stddef.h>

typedef struct Arena Arena;

Arena *arena_new(Error *e);
void arena_free(Arena *arena); // NULL is fine

// Allocates size zeroed bytes, aligned for any type; NULL and e when out of memory.
void *arena_alloc(Arena *arena, size_t size, Error *e);

// Copies length bytes and adds a NUL.
char *arena_text(Arena *arena, const char *bytes, size_t length, Error *e);

// Formats a text, as printf, in the arena.
char *arena_format(Arena *arena, Error *e, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

typedef enum NodeKind { NODE_SCALAR, NODE_LIST, NODE_MAP } NodeKind;

typedef struct Node {
    NodeKind kind;
    bool animated;      // interpolated number: rounded for keys of whole numbers
    bool quoted;        // scalar in quotes, so never a number, a bool or null
    int line, column;   // 1-based; 0 for a node that is in no file (a default)
    const char *source; // origin, "override path=value"; NULL = a file
    const char *file;   // the file it is in; NULL = the scene file
    const char *text;   // scalar
    const char *key;    // when the parent is a map
    int key_line, key_column;
    struct Node *first, *last, *next; // children of a list or a map; the next sibling
    int count;                        // of children
    int height;                       // levels of nodes below
} Node;

Node *node_new(Arena *arena, NodeKind kind, Error *e);
Node *node_scalar(Arena *arena, const char *text, Error *e); // text is borrowed from the arena

// Appends child to parent; key: for maps, borrowed from the arena; NULL for lists.
void node_append(Node *parent, Node *child, const char *key);

// The child of a map with this key; NULL when there is none or map is NULL or not a map.
Node *node_get(const Node *map, const char *key);

// One step of a path: the child of a map with this key, or the entry of a list with this name or
// number, counted from 0. NULL when there is none or node is a scalar.
Node *node_step(const Node *node, const char *token);

// The deepest node on a path of keys, names and numbers ("objects.oak.tree.height"). *rest: the
// part of the path below it, part of `path`; "" = the node is the path's own.
const Node *node_follow(const Node *root, const char *path, const char **rest);

// Text of a scalar child; NULL when there is none.
const char *node_get_text(const Node *map, const char *key);

// The node for a message about map's key: the key's value, else map itself.
static inline const Node *node_place(const Node *map, const char *key)
{
    const Node *child = node_get(map, key);
    return child ? child : map;
}

// Copies the whole tree below node. *budget: the number of nodes still allowed; a long text counts
// as several. ERROR_INPUT when it is exhausted.
Node *node_copy(Arena *arena, const Node *node, int *budget, Error *e);

// Adds copies of the entries of a map that the map does not have, and goes on below the maps that
// both have: values of `map` stay. *budget: as for node_copy.
bool node_merge(Arena *arena, Node *map, const Node *from, int *budget, Error *e);

// Removes child from parent.
void node_remove(Node *parent, const Node *child);

// Is the scalar empty, ~ or null (and not quoted)?
bool node_is_null(const Node *node);

#endif
