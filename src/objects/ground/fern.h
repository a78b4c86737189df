// A fern: a rosette of arching fronds, each a row of leaflets on both sides that shorten to its
// tip.
#ifndef RAMIFY_OBJECTS_GROUND_FERN_H
#define RAMIFY_OBJECTS_GROUND_FERN_H

#include "base/mesh.h"

// A fern of this height (m) about the origin, growing along +Y, as one mesh of some thousand quads.
Mesh *fern_mesh_new(float height, uint64_t seed, Error *e);

#endif
