// A YAML document as a tree of nodes that remember where they stand in the file. All nodes and
// texts of a document live in one arena and go with it.
#ifndef RAMIFY_CONFIG_NODE_H
#define RAMIFY_CONFIG_NODE_H

#include "base/error.h"

#include <stddef.h>

typedef struct Arena Arena;

Arena *arena_new(Error *e);
void arena_free(Arena *arena); // NULL is fine

// size zeroed bytes, aligned for any type; NULL and e when memory is short. Freed with the arena.
void *arena_alloc(Arena *arena, size_t size, Error *e);

// A copy of length bytes with a NUL after them.
char *arena_text(Arena *arena, const char *bytes, size_t length, Error *e);

// printf into the arena.
char *arena_format(Arena *arena, Error *e, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

typedef enum NodeKind { NODE_SCALAR, NODE_LIST, NODE_MAP } NodeKind;

typedef struct Node {
    NodeKind kind;
    bool animated;      // a number between two keys: rounded where a whole one is asked for
    bool quoted;        // scalar written with quotes, so never a number, a truth value or null
    int line, column;   // 1-based; 0 for a node that no file holds (a default)
    const char *source; // "--set path=value" it comes from; NULL = the scene file
    const char *text;   // scalar
    const char *key;    // when the parent is a map
    int key_line, key_column;
    struct Node *first, *last, *next; // children of a list or a map; the next sibling
    int count;                        // of children
    int height;                       // levels of nodes below
} Node;

Node *node_new(Arena *arena, NodeKind kind, Error *e);
Node *node_scalar(Arena *arena, const char *text, Error *e); // text is borrowed from the arena

// Puts child at the end of parent; key for maps, NULL for lists, borrowed from the arena.
void node_append(Node *parent, Node *child, const char *key);

// The child of a map with this key; NULL when there is none or map is NULL or no map.
Node *node_get(const Node *map, const char *key);

// Text of a scalar child; NULL when there is none.
const char *node_get_text(const Node *map, const char *key);

// Where a message about map's key points: at the key's value, else at map itself.
static inline const Node *node_place(const Node *map, const char *key)
{
    const Node *child = node_get(map, key);
    return child ? child : map;
}

// A copy of the whole tree below node. *budget is the number of nodes still allowed, where a long
// text counts as several; running out is ERROR_INPUT.
Node *node_copy(Arena *arena, const Node *node, int *budget, Error *e);

// Takes child out of parent.
void node_remove(Node *parent, const Node *child);

// Is the scalar empty, ~ or null (and not quoted)?
bool node_is_null(const Node *node);

#endif
