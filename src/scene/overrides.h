// --set path=value: changes to a document before it is checked.
#ifndef RAMIFY_SCENE_OVERRIDES_H
#define RAMIFY_SCENE_OVERRIDES_H

#include "config/node.h"
#include "scene/scene.h"

// Carries out one override, "camera.fov=35" or "objects.oak.tree.leaves.max_count=0". Entries of a
// list go by their number, from 0, or by their name. Mappings on the way are made when missing;
// whether the keys exist is for the tables to say. The value is YAML: 3, [1, 2, 3], {a: 1}.
bool override_apply(Arena *arena, Node *root, const char *override, Error *e);

// The same for a change that comes from elsewhere; see scene.h.
bool override_change(Arena *arena, Node *root, const SceneChange *change, Error *e);

#endif
