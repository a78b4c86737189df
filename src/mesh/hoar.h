// Hoar frost: tufts of ice needles.
#ifndef RAMIFY_MESH_HOAR_H
#define RAMIFY_MESH_HOAR_H

#include "base/mesh.h"

// A tuft on the origin that grows along +Y, 1 high: needles with barbs, each a closed pyramid of
// three sides. spread: how far needles turn from +Y, degrees. Free with mesh_free.
Mesh *hoar_tuft(float spread, uint64_t key, Error *e);

// The same of feathers: flat fronds, each an axis with blades in two rows, 60 degrees off, which
// shorten toward its tip.
Mesh *hoar_feathers(float spread, uint64_t key, Error *e);

#endif
