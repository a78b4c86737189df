#include "scene/scene.h"

#include "base/memory.h"
#include "scene/emit.h"
#include "scene/load.h"
#include "scene/overrides.h"
#include "scene/resolve.h"
#include "scene/yaml.h"

#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LARGEST_FILE (16 << 20) // bytes

// Parsed, overridden and completed; NULL and e otherwise.
static Node *complete_document(Arena *arena, Resolver *resolver, const char *text, size_t length,
                               const char *const *overrides, int override_count, Error *e)
{
    const char *zero = memchr(text, 0, length);
    if (zero) {
        error_set(e, ERROR_INPUT,
                  "not a text file: a NUL at byte %td; a scene is YAML text in UTF-8", zero - text);
        error_locate(e, resolver->file, 0, 0);
        return NULL;
    }
    Node *root = yaml_parse(arena, text, length, resolver->file, NULL, e);
    for (int i = 0; root && i < override_count; i++) {
        if (!override_apply(arena, root, overrides[i], e)) {
            return NULL;
        }
    }
    return root ? resolve_document(resolver, &scene_table, root) : NULL;
}

static Scene *load_scene(const Node *document, Arena *arena, const char *text, size_t length,
                         const char *name, Error *e)
{
    Scene *scene = load_struct(&scene_table, document, arena, e);
    if (!scene) {
        return NULL;
    }
    size_t unused;
    scene->file = memory_copy_string(name, e);
    scene->text = memory_alloc_zero((int64_t)length + 1, 1, e);
    scene->resolved = emit_yaml(document, EMIT_READABLE, &unused, e);
    if (!scene->file || !scene->text || !scene->resolved) {
        scene_free(scene);
        return NULL;
    }
    memcpy(scene->text, text, length);
    scene->render.seed = scene->seed;
    return scene;
}

Scene *scene_read_text(const char *text, size_t length, const char *name, const char *folder,
                       const char *const *overrides, int override_count, Error *e)
{
    Error own;
    if (!e) {
        e = &own;
    }
    *e = (Error){0};
    Arena *arena = arena_new(e);
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", NULL);
    Scene *scene = NULL;
    if (arena && c_locale) {
        locale_t before = uselocale(c_locale); // decimal points, whatever the caller's language
        Resolver resolver = {arena, name, folder, e};
        const Node *document =
            complete_document(arena, &resolver, text, length, overrides, override_count, e);
        scene = document ? load_scene(document, arena, text, length, name, e) : NULL;
        uselocale(before);
    }
    if (c_locale) {
        freelocale(c_locale);
    } else {
        error_set(e, ERROR_MEMORY, "out of memory for the C locale");
    }
    arena_free(arena);
    return scene;
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
        free(scene);
    }
}
