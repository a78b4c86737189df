// The water of a scene, where land plants do not grow: its medium, and shapes and meshes of water.
#ifndef RAMIFY_SCENE_SCENE_FLOOD_H
#define RAMIFY_SCENE_SCENE_FLOOD_H

#include "mesh/cover.h"
#include "objects/common/surroundings.h"
#include "scene/scene.h"

typedef struct SceneFlood {
    float level;  // of the medium's surface, m; -INFINITY = none
    Cover *cover; // owned; NULL = no bodies of water
    Flood flood;  // for the recipes; borrows this struct
} SceneFlood;

// Finds all water of the whole scene.
bool scene_flood_init(SceneFlood *flood, const Scene *scene, const Run *run, Error *e);
void scene_flood_clear(SceneFlood *flood);

// Hash of the water: equal for scenes with equal water; 0 = none.
uint64_t scene_flood_hash(const Scene *scene);

#endif
