// OpenSubdiv bridge: limit points of a patch of a quad cage.
#ifndef RAMIFY_MESH_LIMIT_PATCH_H
#define RAMIFY_MESH_LIMIT_PATCH_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

// Attributes of a surface point; before refinement, a cage vertex (normal unused).
typedef struct LimitPoint {
    Vec3 position, normal;
    Vec2 uv;
    float radius, birth;
} LimitPoint;

// Faces cut out of a cage for refinement: the wanted faces first, then those that share a vertex
// with them, which influence their shape.
typedef struct LimitPatch {
    int32_t vertex_count, face_count, wanted_count;
    int32_t *index;     // face_count * 4, into vertex
    LimitPoint *vertex; // vertex_count
} LimitPatch;

// Refines `level` >= 1 times by Catmull-Clark and writes, for each wanted face, the (2^level + 1)^2
// points of its limit surface: row by row, x from corner 0 to corner 1, y from corner 0 to corner
// 3.
bool limit_patch_evaluate(const LimitPatch *patch, int level, LimitPoint *grid, Error *e);

#endif
