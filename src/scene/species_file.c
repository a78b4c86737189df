#include "scene/species_file.h"

#include "config/file_text.h"
#include "config/hint.h"
#include "config/yaml.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_NAMES = 256 };

// The files of scenes/species/ when ramify was built: NAME, NUL, text, NUL, ... and an empty name.
extern const char species_library[];

const char *species_builtin(int index, const char **text)
{
    const char *name = species_library;
    for (; *name; index--) {
        const char *own = name + strlen(name) + 1;
        if (index == 0) {
            if (text) {
                *text = own;
            }
            return name;
        }
        name = own + strlen(own) + 1;
    }
    return NULL;
}

static const char *builtin_text(const char *name)
{
    const char *known, *text;
    for (int i = 0; (known = species_builtin(i, &text)); i++) {
        if (strcmp(known, name) == 0) {
            return text;
        }
    }
    return NULL;
}

static void fail_at(const Node *node, const char *scene, Error *e)
{
    if (node->source) {
        error_locate(e, node->source, 0, 0);
    } else {
        error_locate(e, node->file ? node->file : scene, node->line, node->column);
    }
}

static void say_unknown(const Node *named, const char *scene, Error *e)
{
    const char *names[MOST_NAMES];
    char hint[512];
    int count = 0;
    while (count < MOST_NAMES && (names[count] = species_builtin(count, NULL))) {
        count++;
    }
    hint_format(named->text, names, count, hint, sizeof hint);
    error_set(e, ERROR_INPUT, "there is no species '%.60s'; %s", named->text, hint);
    fail_at(named, scene, e);
}

static bool is_path(const char *text)
{
    size_t length = strlen(text);
    return strchr(text, '/') || (length > 5 && strcmp(text + length - 5, ".yaml") == 0);
}

// Letters, digits, '_' and '-' alone, so that a name is never a path and material names are words.
static bool check_stem(const char *stem, const Node *named, const char *scene, Error *e)
{
    bool done = *stem;
    for (const char *c = stem; *c; c++) {
        done = done && (isalnum((unsigned char)*c) || *c == '_' || *c == '-');
    }
    if (!done) {
        error_set(e, ERROR_INPUT,
                  "species: '%.60s' is no name of a species; use letters, digits, _ and -", stem);
        fail_at(named, scene, e);
    }
    return done;
}

// The path relative to the file that the node is in.
static const char *join(const Node *named, const char *text, const char *folder, Arena *arena,
                        Error *e)
{
    const char *slash = named->file && *named->file != '<' ? strrchr(named->file, '/') : NULL;
    if (*text == '/' || (!slash && !*folder)) {
        return text;
    }
    return slash ? arena_format(arena, e, "%.*s/%s", (int)(slash - named->file), named->file, text)
                 : arena_format(arena, e, "%s/%s", folder, text);
}

static const char *stem_of(const char *path, Arena *arena, Error *e)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length = strlen(name);
    length -= length > 5 && strcmp(name + length - 5, ".yaml") == 0 ? 5 : 0;
    return arena_text(arena, name, length, e);
}

// The text of the file: borrowed from the library or owned by the arena.
static const char *read_text(const char *path, const Node *named, const char *scene, Arena *arena,
                             Error *e)
{
    size_t length;
    char *heap = file_text_read(path, "species", &length, e);
    if (!heap) {
        error_quote_file(e);
        fail_at(named, scene, e);
        return NULL;
    }
    const char *text = arena_text(arena, heap, length, e);
    if (text && strlen(text) < length) {
        error_set(e, ERROR_INPUT, "not a text file; a species is YAML text in UTF-8");
        error_locate(e, path, 0, 0);
        text = NULL;
    }
    free(heap);
    return text;
}

static const char *find_text(SpeciesFile *file, const Node *named, const char *scene,
                             const char *folder, Arena *arena, Error *e)
{
    if (is_path(named->text)) {
        file->path = join(named, named->text, folder, arena, e);
        file->stem = file->path ? stem_of(file->path, arena, e) : NULL;
        return file->stem && check_stem(file->stem, named, scene, e)
                   ? read_text(file->path, named, scene, arena, e)
                   : NULL;
    }
    file->stem = named->text;
    if (!check_stem(file->stem, named, scene, e)) {
        return NULL;
    }
    file->path =
        arena_format(arena, e, "%s%sspecies/%s.yaml", folder, *folder ? "/" : "", named->text);
    if (!file->path || access(file->path, F_OK) == 0) {
        return file->path ? read_text(file->path, named, scene, arena, e) : NULL;
    }
    file->path = arena_format(arena, e, "<species>/%s.yaml", named->text);
    const char *text = builtin_text(named->text);
    if (!text) {
        say_unknown(named, scene, e);
    }
    return file->path ? text : NULL;
}

static void set_file(Node *node, const char *file)
{
    node->file = file;
    for (Node *child = node->first; child; child = child->next) {
        set_file(child, file);
    }
}

bool species_file_read(SpeciesFile *file, const Node *named, const char *scene, const char *folder,
                       Arena *arena, Error *e)
{
    if (named->kind != NODE_SCALAR || node_is_null(named)) {
        error_set(e, ERROR_INPUT, "species must be a name or the path of a species file");
        fail_at(named, scene, e);
        return false;
    }
    const char *text = find_text(file, named, scene, folder, arena, e);
    Node *root = text ? yaml_parse(arena, text, strlen(text), file->path, NULL, e) : NULL;
    if (root && root->kind != NODE_MAP) {
        error_set(e, ERROR_INPUT,
                  "not a species; a species file is a mapping of keys of an "
                  "object, materials and targets");
        error_locate(e, file->path, root->line, root->column);
        return false;
    }
    if (root) {
        set_file(root, file->path);
    }
    file->text = text;
    file->root = root;
    return root;
}
