#include "scene/scene.h"

#include "base/c_locale.h"
#include "base/memory.h"
#include "config/load.h"
#include "config/yaml.h"
#include "scene/builtin.h"
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

// The source of a scene.
typedef struct SceneSource {
    const char *text;
    size_t length;
    const char *name, *folder;
    const char *const *overrides;
    int override_count;
    const SceneChange *changes;
    int change_count;
} SceneSource;

// The parsed document with overrides applied; NULL and e on failure.
static Node *read_document(Arena *arena, const SceneSource *source, Error *e)
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
    if (root && root->kind != NODE_MAP && !node_is_null(root)) { // has no keys to override
        return root;
    }
    for (int i = 0; root && i < source->override_count; i++) {
        if (!override_apply(arena, root, source->overrides[i], e)) {
            return NULL;
        }
    }
    for (int i = 0; root && i < source->change_count; i++) {
        const SceneChange *change = &source->changes[i];
        if (!override_change(arena, root, change, e)) {
            error_locate(e, source->name, change->line, change->column);
            return NULL;
        }
    }
    return root;
}

// "path=value\0 ... \0"
static char *keep_overrides(Arena *arena, const SceneSource *source, Error *e)
{
    size_t length = 1;
    for (int i = 0; i < source->override_count; i++) {
        length += strlen(source->overrides[i]) + 1;
    }
    char *kept = arena_alloc(arena, length, e), *at = kept;
    for (int i = 0; kept && i < source->override_count; i++) {
        at = stpcpy(at, source->overrides[i]) + 1;
    }
    return kept;
}

// Stores the scene's source in it.
static bool keep_source(Scene *scene, const SceneSource *source, Error *e)
{
    Arena *arena = scene->arena;
    scene->file = arena_text(arena, source->name, strlen(source->name), e);
    scene->folder = arena_text(arena, source->folder, strlen(source->folder), e);
    scene->text = arena_text(arena, source->text, source->length, e);
    scene->overrides = keep_overrides(arena, source, e);
    return scene->file && scene->folder && scene->text && scene->overrides;
}

// Creates the scene of a document. It takes over the arena.
static Scene *load_scene(Arena *arena, const Node *document, const SceneSource *source, Error *e)
{
    Loader loader = {.arena = arena, .file = source->name, .folder = source->folder, .e = e};
    Scene *scene = load_document(&loader, &scene_table, document);
    if (!scene) {
        return NULL;
    }
    scene->arena = arena;
    scene->files = loader.hash;
    scene->render.seed = scene->seed;
    scene->resolved = settle_write(scene, loader.files, e);
    return scene->resolved && keep_source(scene, source, e) ? scene : NULL;
}

static Scene *read_source(const SceneSource *source, Error *e)
{
    Error own;
    if (!e) {
        e = &own;
    }
    *e = (Error){0};
    Arena *nodes = arena_new(e), *kept = nodes ? arena_new(e) : NULL;
    Scene *scene = NULL;
    CLocale locale;
    if (kept && c_locale_enter(&locale, e)) {
        const Node *document = read_document(nodes, source, e);
        scene = document ? load_scene(kept, document, source, e) : NULL;
        c_locale_leave(&locale);
    }
    arena_free(nodes);
    if (!scene) {
        arena_free(kept);
    }
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

// Reads the whole file as heap text.
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

int scene_find_object(const Scene *scene, const char *name)
{
    for (int i = 0; i < scene->object_count; i++) {
        if (strcmp(scene->objects[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}

const Material *scene_material(const Scene *scene, const char *name)
{
    for (int i = 0; i < scene->material_count; i++) {
        if (strcmp(scene->materials[i].name, name) == 0) {
            return &scene->materials[i];
        }
    }
    return builtin_material(name);
}

void scene_free(Scene *scene)
{
    if (scene) {
        arena_free(scene->arena);
    }
}
