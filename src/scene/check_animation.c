// Checks of tracks: keys in order of time, all of one kind.
#include "config/node_number.h"
#include "config/scalar.h"
#include "scene/spec_check.h"

#include <stdio.h>
#include <string.h>

// How many numbers a key's value has: 1, those of a list, 3 of a colour "#rrggbb"; 0 = a word.
static int numbers_of(const Node *value)
{
    double number;
    float rgb[3];
    if (value->kind == NODE_LIST) {
        return value->count;
    }
    if (scalar_color(value->text, rgb)) {
        return 3;
    }
    return !value->quoted && scalar_number(value->text, &number) ? 1 : 0;
}

static void describe(int numbers, char text[32])
{
    if (numbers == 0) {
        snprintf(text, 32, "a word");
    } else {
        snprintf(text, 32, "%d number%s", numbers, numbers == 1 ? "" : "s");
    }
}

static bool check_keys(Resolver *r, const Path *path, const Node *given, const Node *keys)
{
    double before = -1.0;
    const Node *first = node_get(keys->first, "value"), *written = node_get(given, "keys")->first;
    for (const Node *key = keys->first; key; key = key->next, written = written->next) {
        double at = node_number(key, "at");
        const Node *value = node_get(key, "value");
        if (!(at > before)) {
            return resolver_fail(r, node_place(written, "at"),
                                 "%s: the key at %g comes after one at %g; order keys by time, one "
                                 "at each",
                                 resolver_path(r, path, NULL), at, before);
        }
        if (numbers_of(value) != numbers_of(first)) {
            char is[32], was[32];
            describe(numbers_of(value), is);
            describe(numbers_of(first), was);
            return resolver_fail(r, node_place(written, "value"),
                                 "%s: this key is %s, the first one %s; all must be alike",
                                 resolver_path(r, path, NULL), is, was);
        }
        before = at;
    }
    return true;
}

static bool append_number(Resolver *r, Node *map, const char *key, int number)
{
    Node *node = node_scalar(r->arena, arena_format(r->arena, r->e, "%d", number), r->e);
    if (!node || !node->text) {
        return false;
    }
    node->flags = KEY_HIDDEN;
    node_append(map, node, key);
    return true;
}

bool check_track(Resolver *r, const Path *path, const Node *given, Node *resolved)
{
    const Node *named = node_get(given, "path");
    if (strcmp(named->text, "animation") == 0 || strncmp(named->text, "animation.", 10) == 0) {
        return resolver_fail(r, named, "%s: the animation cannot change itself; name another value",
                             resolver_path(r, path, NULL));
    }
    return check_keys(r, path, given, node_get(resolved, "keys")) &&
           append_number(r, resolved, "line", named->source ? 0 : named->line) &&
           append_number(r, resolved, "column", named->source ? 0 : named->column);
}
