// Clouds over an object (clouds: over), once that has grown: the level of the ground of fog that
// lies in the valleys of a terrain, and the spray that falls and surf throw up.
#ifndef RAMIFY_SCENE_CLOUD_GROUNDS_H
#define RAMIFY_SCENE_CLOUD_GROUNDS_H

#include "render/world.h"
#include "scene/scene.h"

// Gives world->cloud the floors of fog and the spray over objects that are among the world's parts.
// ERROR_INPUT if the object that `over` names is, for fog, no terrain with land of its own, or
// throws up no spray; the error's key is then clouds.N.over. ERROR_MEMORY.
bool scene_ground_clouds(World *world, const Scene *scene, const Run *run, Error *e);

// Bytes of the scene's clouds, about; of fog over a terrain by the terrain's size and relief.
double scene_cloud_memory(const Scene *scene);

#endif
