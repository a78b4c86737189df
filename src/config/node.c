#include "config/node.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FIRST_BLOCK 8192 // bytes; each further block is twice as large, up to LARGEST_BLOCK
#define LARGEST_BLOCK 65536
#define TEXT_A_VALUE 64 // bytes of text that count as one more value when aliases expand

enum { LONGEST_TOKEN = 255 }; // bytes of one name of a path

typedef struct Block {
    struct Block *next;
    size_t used, size;
    _Alignas(max_align_t) unsigned char bytes[];
} Block;

struct Arena {
    Block *block;
};

Arena *arena_new(Error *e)
{
    return memory_alloc_zero(1, sizeof(Arena), e);
}

void arena_free(Arena *arena)
{
    if (!arena) {
        return;
    }
    for (Block *block = arena->block; block;) {
        Block *next = block->next;
        free(block);
        block = next;
    }
    free(arena);
}

void *arena_alloc(Arena *arena, size_t size, Error *e)
{
    size = (size + _Alignof(max_align_t) - 1) / _Alignof(max_align_t) * _Alignof(max_align_t);
    Block *block = arena->block;
    if (!block || block->size - block->used < size) {
        size_t wanted = !block ? FIRST_BLOCK : 2 * block->size;
        wanted = wanted < LARGEST_BLOCK ? wanted : LARGEST_BLOCK;
        wanted = wanted > size ? wanted : size;
        block = memory_alloc_zero((int64_t)(sizeof(Block) + wanted), 1, e);
        if (!block) {
            return NULL;
        }
        block->size = wanted;
        block->next = arena->block;
        arena->block = block;
    }
    void *memory = block->bytes + block->used;
    block->used += size;
    return memory;
}

char *arena_text(Arena *arena, const char *bytes, size_t length, Error *e)
{
    char *text = arena_alloc(arena, length + 1, e);
    return text ? memcpy(text, bytes, length) : NULL;
}

char *arena_format(Arena *arena, Error *e, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = length < 0 ? NULL : arena_alloc(arena, (size_t)length + 1, e);
    if (text) {
        vsnprintf(text, (size_t)length + 1, format, again);
    }
    va_end(again);
    return text;
}

Node *node_new(Arena *arena, NodeKind kind, Error *e)
{
    Node *node = arena_alloc(arena, sizeof *node, e);
    if (node) {
        node->kind = kind;
        node->text = kind == NODE_SCALAR ? "" : NULL;
    }
    return node;
}

Node *node_scalar(Arena *arena, const char *text, Error *e)
{
    Node *node = text ? node_new(arena, NODE_SCALAR, e) : NULL;
    if (node) {
        node->text = text;
    }
    return node;
}

void node_append(Node *parent, Node *child, const char *key)
{
    child->key = key;
    child->next = NULL;
    if (parent->last) {
        parent->last->next = child;
    } else {
        parent->first = child;
    }
    parent->last = child;
    parent->count++;
    parent->height = parent->height > child->height ? parent->height : child->height + 1;
}

Node *node_get(const Node *map, const char *key)
{
    if (!map || map->kind != NODE_MAP) {
        return NULL;
    }
    for (Node *child = map->first; child; child = child->next) {
        if (strcmp(child->key, key) == 0) {
            return child;
        }
    }
    return NULL;
}

const char *node_get_text(const Node *map, const char *key)
{
    const Node *child = node_get(map, key);
    return child && child->kind == NODE_SCALAR ? child->text : NULL;
}

static Node *entry_named(const Node *list, const char *name)
{
    Node *entry = list->first;
    while (entry) {
        const char *own = node_get_text(entry, "name");
        if (own && strcmp(own, name) == 0) {
            return entry;
        }
        entry = entry->next;
    }
    return NULL;
}

Node *node_step(const Node *node, const char *token)
{
    if (node->kind != NODE_LIST) {
        return node_get(node, token);
    }
    Node *entry = entry_named(node, token);
    char *end;
    long index = strtol(token, &end, 10);
    if (!entry && *end == 0 && end != token && index >= 0) {
        entry = node->first;
        for (long i = 0; entry && i < index; i++) {
            entry = entry->next;
        }
    }
    return entry;
}

const Node *node_follow(const Node *root, const char *path, const char **rest)
{
    const Node *node = root;
    char token[LONGEST_TOKEN + 1];
    while (*path) {
        size_t length = strcspn(path, ".");
        if (length > LONGEST_TOKEN) {
            break;
        }
        memcpy(token, path, length);
        token[length] = 0;
        const Node *next = node_step(node, token);
        if (!next) {
            break;
        }
        node = next;
        path += length + (path[length] == '.');
    }
    *rest = path;
    return node;
}

Node *node_copy(Arena *arena, const Node *node, int *budget, Error *e)
{
    *budget -= 1 + (node->text ? (int)(strlen(node->text) / TEXT_A_VALUE) : 0);
    if (*budget < 0) {
        error_set(
            e, ERROR_INPUT,
            "the aliases of this file expand to too much; the limit is a million values in all");
        return NULL;
    }
    Node *copy = node_new(arena, node->kind, e);
    if (!copy) {
        return NULL;
    }
    *copy = *node;
    copy->first = copy->last = copy->next = NULL;
    copy->count = copy->height = 0;
    for (const Node *child = node->first; child; child = child->next) {
        Node *twin = node_copy(arena, child, budget, e);
        if (!twin) {
            return NULL;
        }
        node_append(copy, twin, child->key);
    }
    return copy;
}

bool node_merge(Arena *arena, Node *map, const Node *from, int *budget, Error *e)
{
    bool done = true;
    for (const Node *entry = from->first; done && entry; entry = entry->next) {
        Node *own = node_get(map, entry->key);
        if (own && own->kind == NODE_MAP && entry->kind == NODE_MAP) {
            done = node_merge(arena, own, entry, budget, e);
        } else if (!own) {
            Node *copy = node_copy(arena, entry, budget, e);
            done = copy;
            if (copy) {
                node_append(map, copy, entry->key);
            }
        }
    }
    return done;
}

void node_remove(Node *parent, const Node *child)
{
    Node *before = NULL;
    for (Node *here = parent->first; here; before = here, here = here->next) {
        if (here != child) {
            continue;
        }
        if (before) {
            before->next = here->next;
        } else {
            parent->first = here->next;
        }
        if (parent->last == here) {
            parent->last = before;
        }
        parent->count--;
        return;
    }
}

bool node_is_null(const Node *node)
{
    return node->kind == NODE_SCALAR && !node->quoted &&
           (!*node->text || strcmp(node->text, "~") == 0 || strcmp(node->text, "null") == 0 ||
            strcmp(node->text, "Null") == 0 || strcmp(node->text, "NULL") == 0);
}
