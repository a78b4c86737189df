// The document of a scene: its text as nodes, with overrides, changes and species applied.
#ifndef RAMIFY_SCENE_DOCUMENT_H
#define RAMIFY_SCENE_DOCUMENT_H

#include "config/node.h"
#include "scene/scene.h"

typedef struct SceneSource {
    const char *text;
    size_t length;
    const char *origin;        // see Scene.origin; NULL = the text
    bool without_files;        // those that it names need not exist
    const char *name, *folder; // for messages; base of relative paths
    const char *const *overrides;
    int override_count;
    const SceneChange *changes;
    int change_count;
} SceneSource;

// Parses the text and applies to it, in this order: overrides and changes that species depend on
// (a species, a height, a position, whole mappings with a species), the species, the other
// overrides and changes, which can thus refer to what a species gives. NULL and e on failure.
Node *document_read(Arena *arena, const SceneSource *source, Error *e);

#endif
