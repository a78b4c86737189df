#include "scene/document.h"

#include "config/yaml.h"
#include "scene/overrides.h"
#include "scene/species.h"

#include <string.h>

// Do species depend on a value put at this path ("objects.oak.tree.height", which may go on with
// "=value")?
static bool is_early(const char *path, const char *value)
{
    const char *end = path + strcspn(path, "="), *last = path;
    int dots = 0;
    for (const char *c = path; c < end; c++) {
        dots += *c == '.';
        last = *c == '.' ? c + 1 : last;
    }
    size_t length = (size_t)(end - last);
    bool is_input = (length == 7 && strncmp(last, "species", length) == 0) ||
                    (length == 6 && strncmp(last, "height", length) == 0) ||
                    (length == 8 && strncmp(last, "position", length) == 0);
    return strncmp(path, "objects", 7) == 0 &&
           (dots == 3 && is_input ? true : strstr(value, "species") != NULL);
}

static bool apply_changes(Arena *arena, Node *root, const SceneSource *source, bool early, Error *e)
{
    for (int i = 0; i < source->override_count; i++) {
        const char *override = source->overrides[i];
        if (is_early(override, override) == early && !override_apply(arena, root, override, e)) {
            return false;
        }
    }
    for (int i = 0; i < source->change_count; i++) {
        const SceneChange *change = &source->changes[i];
        if (is_early(change->path, change->value) == early &&
            !override_change(arena, root, change, e)) {
            error_locate(e, source->name, change->line, change->column);
            return false;
        }
    }
    return true;
}

Node *document_read(Arena *arena, const SceneSource *source, Error *e)
{
    const char *zero = memchr(source->text, 0, source->length);
    if (zero) {
        error_set(e, ERROR_INPUT,
                  "not a text file: a NUL at byte %td; a scene is YAML text in UTF-8",
                  zero - source->text);
        error_locate(e, source->name, 0, 0);
        return NULL;
    }
    Node *root = yaml_parse(arena, source->text, source->length, source->name, NULL, e);
    if (!root || (root->kind != NODE_MAP && !node_is_null(root))) { // has no keys to override
        return root;
    }
    bool done = apply_changes(arena, root, source, true, e) &&
                species_apply(root, source->name, source->folder, arena, e) &&
                apply_changes(arena, root, source, false, e);
    return done ? root : NULL;
}
