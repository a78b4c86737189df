#include "scene/scene.h"

#include "base/c_locale.h"
#include "base/memory.h"
#include "config/file_text.h"
#include "config/load.h"
#include "scene/builtin.h"
#include "scene/document.h"
#include "scene/growths.h"
#include "scene/picture_read.h"
#include "scene/settle.h"
#include "scene/spec.h"

#include <stdlib.h>
#include <string.h>

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
    scene->origin =
        source->origin ? arena_text(arena, source->origin, strlen(source->origin), e) : scene->text;
    scene->overrides = keep_overrides(arena, source, e);
    return scene->file && scene->folder && scene->text && scene->origin && scene->overrides;
}

// Creates the scene of a document. It takes over the arena.
static Scene *load_scene(Arena *arena, const Node *document, const SceneSource *source, Error *e)
{
    Loader loader = {.arena = arena,
                     .file = source->name,
                     .folder = source->folder,
                     .without_files = source->without_files,
                     .e = e};
    Scene *scene = load_document(&loader, &scene_table, document);
    if (!scene) {
        return NULL;
    }
    scene->arena = arena;
    scene->files = loader.hash;
    scene->render.seed = scene->seed;
    scene->resolved = settle_write(scene, loader.files, e);
    bool kept = scene->resolved && keep_source(scene, source, e);
    scene->growths = kept ? growths_new(scene->object_count, e) : NULL;
    return scene->growths ? scene : NULL;
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
        const Node *document = document_read(nodes, source, e);
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

Scene *scene_read_settings(const char *text, const char *origin, const char *name,
                           const char *const *overrides, int override_count, Error *e)
{
    return read_source(&(SceneSource){.text = text,
                                      .length = strlen(text),
                                      .origin = origin,
                                      .without_files = true,
                                      .name = name,
                                      .folder = "",
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
                                                .origin = scene->origin,
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

// The texts of a scene file, or of a picture of it; free() both.
typedef struct SceneTexts {
    char *text, *origin; // see SceneSource
    size_t length;
} SceneTexts;

static bool read_texts(const char *file, SceneTexts *texts, Error *e)
{
    *texts = (SceneTexts){0};
    if (!picture_holds_scene(file)) {
        texts->text = file_text_read(file, "scene", &texts->length, e);
        return texts->text;
    }
    texts->text = picture_read_settings(file, &texts->origin, e);
    texts->length = texts->text ? strlen(texts->text) : 0;
    return texts->text;
}

Scene *scene_read(const char *file, const char *const *overrides, int override_count, Error *e)
{
    SceneTexts texts;
    if (!read_texts(file, &texts, e)) {
        return NULL;
    }
    const char *slash = strrchr(file, '/');
    char *folder = memory_copy_string(slash ? file : "", e);
    Scene *scene = NULL;
    if (folder) {
        if (slash) {
            folder[slash == file ? 1 : slash - file] = 0;
        }
        scene = read_source(&(SceneSource){.text = texts.text,
                                           .length = texts.length,
                                           .origin = texts.origin,
                                           .name = file,
                                           .folder = folder,
                                           .overrides = overrides,
                                           .override_count = override_count},
                            e);
    }
    free(folder);
    free(texts.text);
    free(texts.origin);
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
        growths_free(scene->growths);
        arena_free(scene->arena);
    }
}
