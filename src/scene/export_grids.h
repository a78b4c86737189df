// Exports the envelopes and guide fields of a scene's objects, and its clouds, as grids.
#ifndef RAMIFY_SCENE_EXPORT_GRIDS_H
#define RAMIFY_SCENE_EXPORT_GRIDS_H

#include "scene/scene.h"
#include "shape/grid_file.h"

// Grows the scene. Returns for each element the envelope as a level set, "OBJECT/envelope" or
// "OBJECT/ELEMENT/envelope" ("oak/crown/envelope"), and the guide field, if any, as vectors,
// ".../field"; and for each cloud that is grown its extinction, 1/m, as a fog volume,
// "clouds/NUMBER/density". ERROR_INPUT when there is none. The caller frees the grids.
GridFile *scene_grids(const Scene *scene, const Run *run, Error *e);

#endif
