// The bridge to OpenSubdiv: limit points of a patch of a quad cage.
#ifndef RAMIFY_MESH_LIMIT_PATCH_H
#define RAMIFY_MESH_LIMIT_PATCH_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

// What a surface point carries; before refinement, a cage vertex (normal unused).
typedef struct LimitPoint {
    Vec3 position, normal;
    Vec2 uv;
    float radius, birth;
} LimitPoint;

// Faces of a cage cut out for refinement: the wanted faces first, then those that share a vertex
// with them (their shape reaches into the wanted ones).
typedef struct LimitPatch {
    int32_t vertex_count, face_count, wanted_count;
    int32_t *index;     // face_count * 4, into vertex
    LimitPoint *vertex; // vertex_count
} LimitPatch;

// Refines by Catmull-Clark `level` >= 1 times and writes, for each wanted face, the
// (2^level + 1)^2 points of the limit surface over it: row by row, x from corner 0 to corner 1, y
// from corner 0 to corner 3.
bool limit_patch_evaluate(const LimitPatch *patch, int level, LimitPoint *grid, Error *e);

#endif
