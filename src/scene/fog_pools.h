// Fog that lies in the valleys of a terrain (clouds: over): the level of its ground, from the land
// that has grown.
#ifndef RAMIFY_SCENE_FOG_POOLS_H
#define RAMIFY_SCENE_FOG_POOLS_H

#include "render/world.h"
#include "scene/scene.h"

// Gives world->cloud the floors of fog over terrains that are among the world's parts. ERROR_INPUT
// if the object that `over` names is no terrain with land of its own; the error's key is then
// clouds.N.over. ERROR_MEMORY.
bool scene_pool_fog(World *world, const Scene *scene, const Run *run, Error *e);

// Bytes of the scene's clouds, about; of fog over a terrain by the terrain's size and relief.
double scene_cloud_memory(const Scene *scene);

#endif
