#include "scene/edit.h"

#include "base/memory.h"
#include "config/text.h"
#include "config/yaml.h"

#include <stdlib.h>
#include <string.h>

// One replacement: `removed` bytes at `at` give way to a text.
typedef struct Edit {
    size_t at, removed;
    Text text;
} Edit;

// Byte of line and column, both from 1; a column is a character in UTF-8. The text's length if it
// is shorter.
static size_t find_byte(const char *text, int line, int column)
{
    size_t at = 0;
    for (int i = 1; i < line && text[at]; i++) {
        at += strcspn(text + at, "\n");
        at += text[at] != 0;
    }
    for (int i = 1; i < column && text[at]; i++) {
        do {
            at++;
        } while (((unsigned char)text[at] & 0xC0u) == 0x80u);
    }
    return at;
}

// Puts "b: {c: value}" for the path "b.c".
static void put_nested(Text *out, const char *path, const char *value)
{
    int depth = 0;
    for (const char *at = path; *at;) {
        size_t length = strcspn(at, ".");
        text_put(out, "%s%.*s: ", at == path ? "" : "{", (int)length, at);
        depth += at != path;
        at += at[length] ? length + 1 : length;
    }
    text_put(out, "%s", value);
    for (; depth > 0; depth--) {
        text_put(out, "}");
    }
}

// The value of a key that the text has; false if it is not one plain word there.
static bool replace_scalar(const char *text, const Node *node, const char *value, Edit *edit)
{
    edit->at = find_byte(text, node->line, node->column);
    edit->removed = strlen(node->text);
    text_put(&edit->text, "%s", value);
    return !node->quoted && edit->removed > 0 &&
           strncmp(text + edit->at, node->text, edit->removed) == 0;
}

// The last key of a block mapping, whose keys have one column; `short_value`: of those whose value
// is on the key's line.
static const Node *last_key(const Node *map, bool short_value)
{
    const Node *last = NULL;
    for (const Node *child = map->first; child; child = child->next) {
        bool is_short = child->kind == NODE_SCALAR && child->line == child->key_line &&
                        !strchr(child->text, '\n');
        if (child->key_column == map->column && child->key_line >= map->line &&
            (is_short || !short_value)) {
            last = child;
        }
    }
    return last;
}

// Adds the rest of a path to the deepest mapping of it that the text has.
static bool add_key(const char *text, const Node *map, const char *rest, const char *value,
                    Edit *edit)
{
    size_t start = find_byte(text, map->line, map->column);
    const Node *line = map->kind == NODE_MAP ? last_key(map, true) : NULL;
    const Node *last = map->kind == NODE_MAP ? last_key(map, false) : NULL;
    if (map->kind == NODE_MAP && text[start] == '{') {
        edit->at = start + 1;
        put_nested(&edit->text, rest, value);
        text_put(&edit->text, "%s", map->count > 0 ? ", " : "");
    } else if (line) { // below it
        edit->at = find_byte(text, line->line, line->column);
        edit->at += strcspn(text + edit->at, "\r\n");
        text_put(&edit->text, "\n%*s", map->column - 1, "");
        put_nested(&edit->text, rest, value);
    } else if (last) { // above it
        edit->at = find_byte(text, last->key_line, last->key_column);
        put_nested(&edit->text, rest, value);
        text_put(&edit->text, "\n%*s", map->column - 1, "");
    } else if (node_is_null(map) && map->kind == NODE_SCALAR && !*map->text) { // "tree:"
        edit->at = start;
        text_put(&edit->text, " {");
        put_nested(&edit->text, rest, value);
        text_put(&edit->text, "}");
    } else {
        return false;
    }
    return true;
}

// Plans the edit of one value; false if the text cannot hold it.
static bool plan_edit(const char *text, const Node *root, const char *path, const char *value,
                      Edit *edit)
{
    const char *rest;
    const Node *node = node_follow(root, path, &rest);
    if (*rest) {
        return add_key(text, node, rest, value, edit);
    }
    return node->kind == NODE_SCALAR && replace_scalar(text, node, value, edit);
}

// The text with one value changed, on the heap. *held: false, and NULL, if the text cannot hold it.
static char *change_value(const char *text, const char *path, const char *value, bool *held,
                          Error *e)
{
    Arena *arena = arena_new(e);
    const Node *root = arena ? yaml_parse(arena, text, strlen(text), "", NULL, e) : NULL;
    Edit edit = {.text = {.e = e}};
    *held = root && plan_edit(text, root, path, value, &edit);
    Text changed = {.e = e};
    if (*held && !edit.text.failed) {
        text_put(&changed, "%.*s%s%s", (int)edit.at, text, edit.text.bytes,
                 text + edit.at + edit.removed);
    }
    free(edit.text.bytes);
    arena_free(arena);
    return *held && !edit.text.failed ? text_take(&changed) : NULL;
}

// Replaces *text by the text with one value changed; false, and *text freed, if it cannot.
static bool change_text(char **text, const char *path, const char *value, bool *held, Error *e)
{
    char *changed = change_value(*text, path, value, held, e);
    free(*text);
    *text = changed;
    return changed;
}

// The scene's text with overrides and changes; *held as above.
static char *change_all(const Scene *scene, const SceneChange *changes, int count, bool *held,
                        Error *e)
{
    char *text = memory_copy_string(scene->text, e);
    bool done = text;
    *held = true;
    for (const char *at = scene->overrides; done && *at; at += strlen(at) + 1) {
        size_t length = strcspn(at, "=");
        char *path = memory_copy_string(at, e);
        if (path) {
            path[length] = 0;
        }
        done = path && change_text(&text, path, at + length + 1, held, e);
        free(path);
    }
    for (int i = 0; done && i < count; i++) {
        done = change_text(&text, changes[i].path, changes[i].value, held, e);
    }
    if (!done) {
        free(text);
        text = NULL;
    }
    return text;
}

// Does the text mean what the scene is?
static bool is_scene(const char *text, const Scene *wanted)
{
    Scene *scene = scene_read_text(text, strlen(text), wanted->file, wanted->folder, NULL, 0, NULL);
    bool same = scene && strcmp(scene->resolved, wanted->resolved) == 0;
    scene_free(scene);
    return same;
}

char *scene_edited_text(const Scene *scene, const SceneChange *changes, int count, bool *whole,
                        Error *e)
{
    Scene *wanted = scene_changed(scene, changes, count, e);
    if (!wanted) {
        return NULL;
    }
    Error ignored = {0}; // what cannot be edited is written out
    char *text = change_all(scene, changes, count, whole, &ignored);
    *whole = text && is_scene(text, wanted);
    if (!*whole) {
        free(text);
        text = memory_copy_string(wanted->resolved, e);
    }
    scene_free(wanted);
    return text;
}
