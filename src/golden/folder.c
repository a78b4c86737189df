#include "golden/folder.h"

#include "base/file_beside.h"
#include "base/file_name.h"
#include "base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The name without its extension of 4 or 5 characters.
static char *stem_of(const char *name, Error *e)
{
    char *stem = memory_copy_string(name, e);
    if (stem) {
        *strrchr(stem, '.') = 0;
    }
    return stem;
}

static char *path_of(const char *folder, const char *name, Error *e)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = memory_alloc((int64_t)size, 1, e);
    if (path) {
        bool slash = folder[0] && folder[strlen(folder) - 1] == '/';
        snprintf(path, size, "%s%s%s", folder, slash ? "" : "/", name);
    }
    return path;
}

char *folder_with_ending(const char *file, const char *ending, Error *e)
{
    size_t stem = (size_t)(strrchr(file, '.') - file), length = strlen(ending);
    char *path = memory_alloc((int64_t)(stem + length + 1), 1, e);
    if (path) {
        memcpy(path, file, stem);
        memcpy(path + stem, ending, length + 1);
    }
    return path;
}

void folder_clear(Folder *folder)
{
    for (int64_t i = 0; i < folder->scene_count; i++) {
        free(folder->scenes[i].name);
        free(folder->scenes[i].file);
    }
    for (int64_t i = 0; i < folder->orphan_count; i++) {
        free(folder->orphans[i]);
    }
    free(folder->scenes);
    free(folder->orphans);
    *folder = (Folder){0};
}

static bool add_scene(Folder *folder, const char *path, const char *name, char *stem, Error *e)
{
    char *file = path_of(path, name, e);
    if (!file || !memory_reserve(&folder->scenes, &folder->scene_capacity, folder->scene_count + 1,
                                 sizeof *folder->scenes, e)) {
        free(file);
        free(stem);
        return false;
    }
    folder->scenes[folder->scene_count++] = (FolderScene){stem, file};
    return true;
}

static bool add_orphan(Folder *folder, const char *name, Error *e)
{
    if (!memory_reserve(&folder->orphans, &folder->orphan_capacity, folder->orphan_count + 1,
                        sizeof *folder->orphans, e)) {
        return false;
    }
    char *copy = memory_copy_string(name, e);
    if (copy) {
        folder->orphans[folder->orphan_count++] = copy;
    }
    return copy;
}

// Whether the file contains this text; false for an unreadable file.
static bool file_says(const char *file, const char *text)
{
    FILE *stream = file_open_regular(file, NULL);
    char *line = NULL;
    size_t size = 0;
    bool found = false;
    while (stream && !found && getline(&line, &size, stream) >= 0) {
        found = strstr(line, text);
    }
    free(line);
    if (stream) {
        fclose(stream);
    }
    return found;
}

// Sorted names of the directory entries that match the filter; a NULL-terminated list.
static bool list_names(const char *path, struct dirent ***entries, int *count, Error *e)
{
    *count = scandir(path, entries, NULL, alphasort);
    return *count >= 0 ||
           error_set(e, ERROR_INPUT, "cannot read the folder '%s': %s", path, strerror(errno));
}

static bool add_entry(Folder *folder, const char *path, const char *filter, const char *name,
                      Error *e)
{
    if (name[0] == '.' || !file_name_ends(name, ".yaml")) {
        return true;
    }
    char *stem = stem_of(name, e);
    if (stem && filter && fnmatch(filter, stem, 0) != 0) {
        free(stem);
        return true;
    }
    return stem && add_scene(folder, path, name, stem, e);
}

typedef struct Entries {
    struct dirent **entry;
    int count;
} Entries;

// Whether there is a scene of this name, or one that refers to the picture (as its sky, for
// example).
static bool is_claimed(const Entries *entries, const char *path, const char *image)
{
    size_t stem = (size_t)(strrchr(image, '.') - image);
    for (int i = 0; i < entries->count; i++) {
        const char *name = entries->entry[i]->d_name;
        if (!file_name_ends(name, ".yaml")) {
            continue;
        }
        char *file = path_of(path, name, NULL);
        bool claimed = (strlen(name) == stem + 5 && strncmp(name, image, stem) == 0) ||
                       (file && file_says(file, image));
        free(file);
        if (claimed) {
            return true;
        }
    }
    return false;
}

static bool find_orphans(Folder *folder, const Entries *entries, const char *path,
                         const char *filter, Error *e)
{
    for (int i = 0; i < entries->count; i++) {
        const char *name = entries->entry[i]->d_name;
        if (name[0] == '.' || (!file_name_ends(name, ".png") && !file_name_ends(name, ".exr"))) {
            continue;
        }
        char *stem = stem_of(name, e);
        bool asked = stem && (!filter || fnmatch(filter, stem, 0) == 0);
        bool done =
            stem && (!asked || is_claimed(entries, path, name) || add_orphan(folder, name, e));
        free(stem);
        if (!done) {
            return false;
        }
    }
    return true;
}

bool folder_list(const char *path, const char *filter, Folder *folder, Error *e)
{
    Entries entries = {0};
    *folder = (Folder){0};
    if (!list_names(path, &entries.entry, &entries.count, e)) {
        return false;
    }
    bool done = true;
    for (int i = 0; done && i < entries.count; i++) {
        done = add_entry(folder, path, filter, entries.entry[i]->d_name, e);
    }
    done = done && find_orphans(folder, &entries, path, filter, e);
    for (int i = 0; i < entries.count; i++) {
        free(entries.entry[i]);
    }
    free(entries.entry);
    if (done && folder->scene_count == 0) {
        done = error_set(e, ERROR_INPUT,
                         "no scene %s%s%s in '%s'; NAME.yaml beside NAME.png would be one",
                         filter ? "like '" : "file", filter ? filter : "", filter ? "'" : "", path);
    }
    return done;
}
