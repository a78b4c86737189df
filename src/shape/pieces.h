// The shapes of an envelope's list, prepared: imported and measured, and combined to a level set.
#ifndef RAMIFY_SHAPE_PIECES_H
#define RAMIFY_SHAPE_PIECES_H

#include "shape/body.h"
#include "shape/envelope.h"
#include "shape/level_set.h"
#include "shape/primitive.h"

// A shape of the list, prepared.
typedef struct Piece {
    const Shape *shape;
    Primitive primitive; // unless it is a mesh or a body
    Body body;
    Mesh *mesh;   // as imported, transformed, faces outward; NULL for other kinds
    Mesh *closed; // the same with its holes filled
    int64_t open_edges;
    Aabb bounds;
} Piece;

// Checks the list and loads its shapes, params->shape_count of them; to be freed. NULL on error.
Piece *pieces_load(const EnvelopeParams *params, const Run *run, Error *e);
void pieces_free(Piece *pieces, int count); // NULL is fine

// All of them combined, on voxels of this size, m (0 = largest extent / 128). *inside is set to a
// box that contains the envelope. NULL on error.
LevelSet *pieces_level_set(const Piece *pieces, int count, float voxel, Aabb *inside,
                           const Run *run, Error *e);

// primitive_distance, for level_set_from_distance.
double piece_distance(const void *primitive, Vec3 p, double *bound);

#endif
