// Parts of mesh_dice that know what a mesh holds. Private to mesh/dice.c.
#ifndef RAMIFY_MESH_DICE_SURFACE_H
#define RAMIFY_MESH_DICE_SURFACE_H

#include "mesh/dice.h"

// The faces as triangles, 3 indices each; a quad becomes (0, 1, 3) and (2, 3, 1).
void dice_split_faces(const Mesh *mesh, uint32_t *triangle);

// The mesh's vertices as points; `along` is the mean over the triangles about each.
void dice_fill_points(const Mesh *mesh, const uint32_t *triangle, int64_t triangle_count,
                      DicePoint *point);

// A mesh of triangles of these points, with the arrays that `like` has; its index is not filled.
Mesh *dice_mesh_of(const Mesh *like, const DicePoint *point, int64_t point_count,
                   int64_t face_count, Error *e);

#endif
