// A model that stands in many places: its leaves become one mesh, which traces faster than many
// small instances and can be instanced again. Where the mesh takes coarse leaves, copies near the
// camera keep all leaves in full detail, as instances.
#ifndef RAMIFY_OBJECTS_COMMON_INSTANCED_H
#define RAMIFY_OBJECTS_COMMON_INSTANCED_H

#include "objects/common/recipe.h"

typedef struct Instanced {
    const Transform *place; // from the model at the origin
    int64_t count;
    int64_t most_leaves; // of more, some are left out and the others enlarged to the same area
    int64_t most_faces;  // of all leaves: their coarser forms are taken if there would be more
    bool distant;        // the coarsest forms are enough
    const Vec3 *eye;     // the camera, in the space of the places; NULL = no copy is near
    uint64_t seed;
} Instanced;

// Adds the model's parts, whose materials are set, at all places. Takes over the meshes and curves
// that are drawn once. Leaves keep their colours in a few groups each of one season and variation.
// Adds nothing for 0 places.
bool instanced_add(Geometry *model, const Instanced *how, const Placing *placing, Error *e);

#endif
