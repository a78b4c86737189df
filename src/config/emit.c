#include "config/emit.h"

#include "base/memory.h"
#include "config/table.h"

#include <stdlib.h>
#include <string.h>

typedef struct Emitter {
    char *text;
    int64_t length, capacity;
    EmitMode mode;
    bool failed;
    Error *e;
} Emitter;

static void put_bytes(Emitter *out, const char *bytes, size_t count)
{
    if (out->failed ||
        !memory_reserve(&out->text, &out->capacity, out->length + (int64_t)count + 1, 1, out->e)) {
        out->failed = true;
        return;
    }
    memcpy(out->text + out->length, bytes, count);
    out->length += (int64_t)count;
    out->text[out->length] = 0;
}

static void put(Emitter *out, const char *text)
{
    put_bytes(out, text, strlen(text));
}

static void put_quoted(Emitter *out, const char *text)
{
    put(out, "\"");
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 0x20 || c == 0x7f) {
            const char *hex = "0123456789abcdef";
            char escape[4] = {'\\', 'x', hex[c >> 4], hex[c & 15]};
            put_bytes(out, escape, 4);
        } else {
            if (c == '"' || c == '\\') {
                put(out, "\\");
            }
            put_bytes(out, text, 1);
        }
    }
    put(out, "\"");
}

static void put_scalar(Emitter *out, const Node *node)
{
    if (out->mode == EMIT_LOADABLE) {
        put_quoted(out, node->resolved ? node->resolved : node->text);
    } else if (node->quoted) {
        put_quoted(out, node->text);
    } else {
        put(out, node->text);
    }
}

static bool is_shown(const Emitter *out, const Node *node)
{
    if (out->mode == EMIT_READABLE) {
        return !(node->flags & KEY_HIDDEN);
    }
    bool empty = node->kind == NODE_LIST && node->count == 0; // NULL and 0 already
    return !(node->flags & KEY_VIRTUAL) && !empty;
}

// In one line: [1, 2] and {a: 1}.
static void put_flow(Emitter *out, const Node *node)
{
    if (node->kind == NODE_SCALAR || (out->mode == EMIT_LOADABLE && node->resolved)) {
        put_scalar(out, node);
        return;
    }
    bool map = node->kind == NODE_MAP, first = true;
    put(out, map ? "{" : "[");
    for (const Node *child = node->first; child; child = child->next) {
        if (!is_shown(out, child)) {
            continue;
        }
        put(out, first ? "" : ", ");
        first = false;
        if (map) {
            put(out, child->key);
            put(out, ": ");
        }
        put_flow(out, child);
    }
    put(out, map ? "}" : "]");
}

static void indent(Emitter *out, int depth)
{
    for (int i = 0; i < depth; i++) {
        put(out, "  ");
    }
}

static bool fits_a_line(const Node *node)
{
    return node->height == 0 || (node->kind == NODE_LIST && node->first->kind == NODE_SCALAR);
}

static void put_block(Emitter *out, const Node *node, int depth, bool continued)
{
    for (const Node *child = node->first; child; child = child->next) {
        if (!is_shown(out, child)) {
            continue;
        }
        if (!continued) {
            indent(out, depth);
        }
        continued = false;
        if (node->kind == NODE_LIST) {
            put(out, "- ");
            put_block(out, child, depth + 1, true);
            continue;
        }
        put(out, child->key);
        put(out, ":");
        if (fits_a_line(child)) {
            put(out, " ");
            put_flow(out, child);
            if (child->note && out->mode == EMIT_READABLE) {
                put(out, " # used: ");
                put(out, child->note);
            }
            put(out, "\n");
        } else {
            put(out, "\n");
            put_block(out, child, depth + 1, false);
        }
    }
}

char *emit_yaml(const Node *root, EmitMode mode, size_t *length, Error *e)
{
    Emitter out = {.mode = mode, .e = e};
    put(&out, "");
    if (mode == EMIT_LOADABLE) {
        put_flow(&out, root);
    } else {
        put_block(&out, root, 0, false);
    }
    if (out.failed) {
        free(out.text);
        return NULL;
    }
    *length = (size_t)out.length;
    return out.text;
}
