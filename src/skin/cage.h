// The cage under construction: closed tubes of quads, each child's tube growing out of a block of
// its parent's side faces (box modelling), so that the surface is closed and two-manifold whatever
// the out-tree.
#ifndef RAMIFY_SKIN_CAGE_H
#define RAMIFY_SKIN_CAGE_H

#include "skin/plan.h"

typedef struct SkinCage {
    Vec3 *position;
    Vec2 *uv;
    float *radius, *birth;
    uint32_t *index; // four a face
    Vec3 *face_axis; // per face: the point of the branch's axis that the face must look away from
    int64_t vertex_count, face_count;
    int64_t position_capacity, uv_capacity, radius_capacity, birth_capacity;
    int64_t index_capacity, axis_capacity;
} SkinCage;

// On failure, too, clear it.
bool skin_cage_build(SkinCage *cage, const SkinPlan *plan, const Run *run, Error *e);
void skin_cage_clear(SkinCage *cage);

// A vertex of the cage with all it carries.
typedef struct SkinVertex {
    Vec3 position;
    Vec2 uv;
    float radius, birth;
} SkinVertex;

bool skin_cage_reserve(SkinCage *cage, int64_t more_vertices, int64_t more_faces, Error *e);

// The room must be reserved.
uint32_t skin_cage_add_vertex(SkinCage *cage, SkinVertex vertex);
void skin_cage_add_face(SkinCage *cage, uint32_t a, uint32_t b, uint32_t c, uint32_t d, Vec3 axis);

// Weighted sums: a + w * b.
SkinVertex skin_vertex_madd(SkinVertex a, float w, SkinVertex b);

// Closes a loop of an even number of vertices, at least four, with quads looking the way from
// which the loop runs counter-clockwise.
bool skin_cage_cap(SkinCage *cage, const uint32_t *loop, int count, Vec3 axis, Error *e);

#endif
