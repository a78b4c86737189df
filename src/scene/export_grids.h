// What a scene's objects grow in, as grids.
#ifndef RAMIFY_SCENE_EXPORT_GRIDS_H
#define RAMIFY_SCENE_EXPORT_GRIDS_H

#include "scene/scene.h"
#include "shape/grid_file.h"

// Grows the scene and keeps, of each element that grows in one, the envelope as a level set
// "OBJECT/envelope" or "OBJECT/ELEMENT/envelope" ("oak/crown/envelope") and the guide field, if it
// has one, as vectors ".../field". ERROR_INPUT when nothing grows in an envelope. The caller frees
// the grids.
GridFile *scene_grids(const Scene *scene, const Run *run, Error *e);

#endif
