// Mean value coordinates of a closed triangle mesh (Ju, Schaefer, Warren 2005): a smooth map of all
// of space that follows the mesh's vertices. It is exact for affine motions.
#ifndef RAMIFY_SHAPE_MEAN_VALUE_H
#define RAMIFY_SHAPE_MEAN_VALUE_H

#include "base/mesh.h"

// Where p goes when the vertices of `rest` (triangles, closed) move to those of `posed`. The cost
// is that of a visit to every face.
Vec3 mean_value_carry(const Mesh *rest, const Mesh *posed, Vec3 p);

#endif
