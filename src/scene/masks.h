// Where the layers of materials lie on the parts of a world: their conditions on maps of each
// object's surface, drawn once.
#ifndef RAMIFY_SCENE_MASKS_H
#define RAMIFY_SCENE_MASKS_H

#include "render/world.h"
#include "scene/scene.h"

// Fills world->masks, replacing what was there. A terrain's maps are those of its own samples (see
// Part.land); any other object's are of its meshes that are drawn once, seen from above, and those
// of an instanced mesh are its own. ERROR_INPUT if a surface does not have a map that a layer asks
// for.
bool scene_make_masks(World *world, const Scene *scene, const Run *run, Error *e);

// Bytes of the masks that this scene will need, about.
double scene_mask_memory(const Scene *scene);

#endif
