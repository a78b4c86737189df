#include "export/asset_path.h"

#include "base/memory.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool resolve(const char *path, char resolved[PATH_MAX], Error *e)
{
    return realpath(path, resolved) ||
           error_set(e, ERROR_IO, "'%s' cannot be found: %s", path, strerror(errno));
}

// The folder of file, as seen from the root, without a slash at the end.
static bool resolve_folder(const char *file, char resolved[PATH_MAX], Error *e)
{
    const char *slash = strrchr(file, '/');
    char *folder = slash ? strndup(file, (size_t)(slash - file) + 1) : strdup(".");
    bool done = folder ? resolve(folder, resolved, e)
                       : error_set(e, ERROR_MEMORY, "out of memory for the name '%s'", file);
    free(folder);
    if (done && strcmp(resolved, "/") == 0) {
        resolved[0] = 0;
    }
    return done;
}

char *asset_path(const char *file, const char *asset, Error *e)
{
    char from[PATH_MAX] = "", to[PATH_MAX] = "";
    if (!resolve_folder(file, from, e) || !resolve(asset, to, e)) {
        return NULL;
    }
    size_t same = 0; // characters of whole folders that both lie in
    for (size_t i = 0; from[i] == to[i] || (!from[i] && to[i] == '/'); i++) {
        if (to[i] == '/') {
            same = i;
        }
        if (!from[i]) {
            break;
        }
    }
    int up = 0;
    for (const char *c = from + same; *c; c++) {
        up += *c == '/';
    }
    const char *rest = to + same + 1, *start = up > 0 ? "" : "./";
    size_t size = (size_t)up * 3 + strlen(start) + strlen(rest) + 1;
    char *path = memory_alloc((int64_t)size, 1, e);
    if (!path) {
        return NULL;
    }
    for (int i = 0; i < up; i++) {
        snprintf(path + (size_t)i * 3, size - (size_t)i * 3, "../");
    }
    snprintf(path + (size_t)up * 3, size - (size_t)up * 3, "%s%s", start, rest);
    return path;
}

// Characters of the name before its ending.
static size_t stem_length(const char *file)
{
    const char *slash = strrchr(file, '/'), *dot = strrchr(file, '.');
    const char *base = slash ? slash + 1 : file;
    return dot && dot > base ? (size_t)(dot - file) : strlen(file);
}

char *asset_beside(const char *file, const char *ending, Error *e)
{
    size_t stem = stem_length(file), size = stem + strlen(ending) + 1;
    char *name = memory_alloc((int64_t)size, 1, e);
    if (name) {
        snprintf(name, size, "%.*s%s", (int)stem, file, ending);
    }
    return name;
}

char *asset_of_object(const char *file, const char *object, Error *e)
{
    size_t stem = stem_length(file), size = strlen(file) + strlen(object) + 2;
    char *name = memory_alloc((int64_t)size, 1, e);
    if (name) {
        snprintf(name, size, "%.*s-%s%s", (int)stem, file, object, file + stem);
    }
    return name;
}
