// The cage under construction: closed tubes of quads. Each child's tube grows out of a block of its
// parent's side faces (box modelling), so the surface is closed and two-manifold for any out-tree.
#ifndef RAMIFY_SKIN_CAGE_H
#define RAMIFY_SKIN_CAGE_H

#include "skin/plan.h"

typedef struct SkinCage {
    Vec3 *position;
    Vec2 *uv;
    float *radius, *birth;
    uint32_t *index; // four per face
    Vec3 *face_axis; // per face: the point of the branch's axis that it must face away from
    int64_t vertex_count, face_count;
    int64_t position_capacity, uv_capacity, radius_capacity, birth_capacity;
    int64_t index_capacity, axis_capacity;
} SkinCage;

// Builds the cage. Clear it after a failure, too.
bool skin_cage_build(SkinCage *cage, const SkinPlan *plan, const Run *run, Error *e);
void skin_cage_clear(SkinCage *cage);

// A vertex of the cage with its attributes.
typedef struct SkinVertex {
    Vec3 position;
    Vec2 uv;
    float radius, birth;
} SkinVertex;

bool skin_cage_reserve(SkinCage *cage, int64_t more_vertices, int64_t more_faces, Error *e);

// Append to space already reserved.
uint32_t skin_cage_add_vertex(SkinCage *cage, SkinVertex vertex);
void skin_cage_add_face(SkinCage *cage, uint32_t a, uint32_t b, uint32_t c, uint32_t d, Vec3 axis);

// Weighted sum a + w * b of all attributes.
SkinVertex skin_vertex_madd(SkinVertex a, float w, SkinVertex b);

// Closes a loop of at least four vertices, an even number, with quads facing the side from which
// the loop runs counter-clockwise.
bool skin_cage_cap(SkinCage *cage, const uint32_t *loop, int count, Vec3 axis, Error *e);

#endif
