// Carries objects by the deformations that their `deform` lists.
#ifndef RAMIFY_SCENE_CARRY_H
#define RAMIFY_SCENE_CARRY_H

#include "objects/kind.h"
#include "shape/deformation.h"

// Moves the nodes of an out-tree, given in a space that to_scene takes into the scene, and turns
// their normals along. ERROR_CANCELLED.
bool carry_tree(const Deformation *deformation, const Transform *to_scene, OutTree *tree,
                const Run *run, Error *e);

// Moves the vertices of the parts of geometry from number first on, which are in the scene.
bool carry_parts(const Deformation *deformation, Geometry *geometry, int64_t first, const Run *run,
                 Error *e);

#endif
