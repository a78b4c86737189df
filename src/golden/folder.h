// Lists a folder of golden images.
#ifndef RAMIFY_GOLDEN_FOLDER_H
#define RAMIFY_GOLDEN_FOLDER_H

#include "base/error.h"

#include <stdint.h>

typedef struct FolderScene {
    char *name, *file; // "oak", "golden/oak.yaml"; owned
} FolderScene;

typedef struct Folder {
    FolderScene *scenes; // *.yaml, sorted by name
    char **orphans;      // names of .png and .exr files without a scene that no scene refers to
    int64_t scene_count, scene_capacity, orphan_count, orphan_capacity;
} Folder;

// filter: pattern of names to take, with * and ?; NULL = all. ERROR_INPUT when the folder cannot be
// read or no scene matches. The caller clears the folder in any case.
bool folder_list(const char *path, const char *filter, Folder *folder, Error *e);
void folder_clear(Folder *folder);

// Copies file with its extension replaced; heap text.
char *folder_with_ending(const char *file, const char *ending, Error *e);

#endif
