// --set path=value: changes to a document before it is checked.
#ifndef RAMIFY_SCENE_OVERRIDES_H
#define RAMIFY_SCENE_OVERRIDES_H

#include "config/node.h"
#include "scene/scene.h"

// Applies one override, "camera.fov=35" or "objects.oak.tree.leaves.max_count=0". Entries of a list
// are selected by number, from 0, or by name. Missing mappings on the path are created; the tables
// check later whether the keys exist. The value is YAML: 3, [1, 2, 3], {a: 1}.
bool override_apply(Arena *arena, Node *root, const char *override, Error *e);

// Applies a change that is not a "path=value" text; see SceneChange in scene.h.
bool override_change(Arena *arena, Node *root, const SceneChange *change, Error *e);

#endif
