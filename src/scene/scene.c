#include "scene/scene.h"

#include "base/c_locale.h"
#include "base/memory.h"
#include "config/emit.h"
#include "config/load.h"
#include "config/resolve.h"
#include "config/yaml.h"
#include "scene/overrides.h"
#include "scene/settle.h"
#include "scene/spec.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LARGEST_FILE (16 << 20) // bytes

// What a scene is read from.
typedef struct SceneSource {
    const char *text;
    size_t length;
    const char *name, *folder;
    const char *const *overrides;
    int override_count;
    const SceneChange *changes;
    int change_count;
} SceneSource;

// Parsed, overridden and completed; NULL and e otherwise.
static Node *complete_document(Arena *arena, Resolver *resolver, const SceneSource *source,
                               Error *e)
{
    const char *zero = memchr(source->text, 0, source->length);
    if (zero) {
        error_set(e, ERROR_INPUT,
                  "not a text file: a NUL at byte %td; a scene is YAML text in UTF-8",
                  zero - source->text);
        error_locate(e, resolver->file, 0, 0);
        return NULL;
    }
    Node *root = yaml_parse(arena, source->text, source->length, resolver->file, NULL, e);
    if (root && root->kind != NODE_MAP && !node_is_null(root)) { // nothing that could be overridden
        return resolve_document(resolver, &scene_table, root);
    }
    for (int i = 0; root && i < source->override_count; i++) {
        if (!override_apply(arena, root, source->overrides[i], e)) {
            return NULL;
        }
    }
    for (int i = 0; root && i < source->change_count; i++) {
        const SceneChange *change = &source->changes[i];
        if (!override_change(arena, root, change, e)) {
            error_locate(e, resolver->file, change->line, change->column);
            return NULL;
        }
    }
    return root ? resolve_document(resolver, &scene_table, root) : NULL;
}

// "path=value\0 ... \0" on the heap.
static char *keep_overrides(const SceneSource *source, Error *e)
{
    int64_t length = 1;
    for (int i = 0; i < source->override_count; i++) {
        length += (int64_t)strlen(source->overrides[i]) + 1;
    }
    char *kept = memory_alloc_zero(length, 1, e), *at = kept;
    for (int i = 0; kept && i < source->override_count; i++) {
        size_t size = strlen(source->overrides[i]) + 1;
        memcpy(at, source->overrides[i], size);
        at += size;
    }
    return kept;
}

static Scene *load_scene(Node *document, Arena *arena, const SceneSource *source, Error *e)
{
    Scene *scene = load_struct(&scene_table, document, arena, e);
    if (!scene) {
        return NULL;
    }
    size_t unused;
    scene->file = memory_copy_string(source->name, e);
    scene->folder = memory_copy_string(source->folder, e);
    scene->overrides = keep_overrides(source, e);
    scene->text = memory_alloc_zero((int64_t)source->length + 1, 1, e);
    scene->resolved = settle_notes(scene, document, arena, e)
                          ? emit_yaml(document, EMIT_READABLE, &unused, e)
                          : NULL;
    if (!scene->file || !scene->folder || !scene->overrides || !scene->text || !scene->resolved) {
        scene_free(scene);
        return NULL;
    }
    memcpy(scene->text, source->text, source->length);
    scene->render.seed = scene->seed;
    return scene;
}

static Scene *read_source(const SceneSource *source, Error *e)
{
    Error own;
    if (!e) {
        e = &own;
    }
    *e = (Error){0};
    Arena *arena = arena_new(e);
    Scene *scene = NULL;
    CLocale locale;
    if (arena && c_locale_enter(&locale, e)) {
        Resolver resolver = {arena, source->name, source->folder, e, 0};
        Node *document = complete_document(arena, &resolver, source, e);
        scene = document ? load_scene(document, arena, source, e) : NULL;
        if (scene) {
            scene->files = resolver.files;
        }
        c_locale_leave(&locale);
    }
    arena_free(arena);
    return scene;
}

Scene *scene_read_text(const char *text, size_t length, const char *name, const char *folder,
                       const char *const *overrides, int override_count, Error *e)
{
    return read_source(&(SceneSource){.text = text,
                                      .length = length,
                                      .name = name,
                                      .folder = folder,
                                      .overrides = overrides,
                                      .override_count = override_count},
                       e);
}

Scene *scene_changed(const Scene *scene, const SceneChange *changes, int count, Error *e)
{
    int override_count = 0;
    for (const char *at = scene->overrides; *at; at += strlen(at) + 1) {
        override_count++;
    }
    const char **overrides = memory_alloc(override_count, sizeof *overrides, e);
    if (!overrides) {
        return NULL;
    }
    const char *at = scene->overrides;
    for (int i = 0; i < override_count; i++, at += strlen(at) + 1) {
        overrides[i] = at;
    }
    Scene *changed = read_source(&(SceneSource){.text = scene->text,
                                                .length = strlen(scene->text),
                                                .name = scene->file,
                                                .folder = scene->folder,
                                                .overrides = overrides,
                                                .override_count = override_count,
                                                .changes = changes,
                                                .change_count = count},
                                 e);
    free(overrides);
    return changed;
}

// The whole file as heap text.
static char *read_file(const char *file, size_t *length, Error *e)
{
    struct stat status;
    int descriptor = open(file, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0 || fstat(descriptor, &status) != 0) {
        error_set(e, ERROR_INPUT, "cannot read it: %s; name a scene file", strerror(errno));
    } else if (!S_ISREG(status.st_mode)) {
        error_set(e, ERROR_INPUT, "a %s; name a scene file",
                  S_ISDIR(status.st_mode) ? "folder" : "device or pipe");
    } else if (status.st_size > LARGEST_FILE) {
        error_set(e, ERROR_INPUT, "%.1f MB long; a scene has at most %d MB",
                  (double)status.st_size / 1048576.0, LARGEST_FILE >> 20);
    } else {
        char *text = memory_alloc((int64_t)status.st_size + 1, 1, e);
        ssize_t count = 0;
        *length = 0;
        while (text &&
               (count = read(descriptor, text + *length, (size_t)status.st_size - *length)) > 0) {
            *length += (size_t)count;
        }
        if (text && count < 0) {
            error_set(e, ERROR_IO, "cannot read it: %s", strerror(errno));
            free(text);
            text = NULL;
        }
        close(descriptor);
        return text;
    }
    if (descriptor >= 0) {
        close(descriptor);
    }
    return NULL;
}

Scene *scene_read(const char *file, const char *const *overrides, int override_count, Error *e)
{
    size_t length;
    char *text = read_file(file, &length, e);
    if (!text) {
        error_locate(e, file, 0, 0);
        return NULL;
    }
    const char *slash = strrchr(file, '/');
    char *folder = memory_copy_string(slash ? file : "", e);
    Scene *scene = NULL;
    if (folder) {
        if (slash) {
            folder[slash == file ? 1 : slash - file] = 0;
        }
        scene = scene_read_text(text, length, file, folder, overrides, override_count, e);
    }
    free(folder);
    free(text);
    return scene;
}

void scene_free(Scene *scene)
{
    if (scene) {
        load_clear(&scene_table, scene);
        free(scene->file);
        free(scene->text);
        free(scene->resolved);
        free(scene->folder);
        free(scene->overrides);
        free(scene);
    }
}
