// The cage under construction: tubes of four-sided rings, each child's tube growing out of a side
// face of its parent's (box modelling), so that the surface is closed and two-manifold whatever
// the out-tree.
#ifndef RAMIFY_MESH_SKIN_CAGE_H
#define RAMIFY_MESH_SKIN_CAGE_H

#include "mesh/skin_plan.h"

typedef struct SkinCage {
    Vec3 *position;
    Vec2 *uv;
    float *radius, *birth;
    uint32_t *index;
    Vec3 *face_axis; // per face: the point of the branch's axis that the face must look away from
    int64_t vertex_count, face_count;
    int64_t position_capacity, uv_capacity, radius_capacity, birth_capacity;
    int64_t index_capacity, axis_capacity;
} SkinCage;

bool skin_cage_build(SkinCage *cage, const SkinPlan *plan, const Run *run, Error *e);
void skin_cage_clear(SkinCage *cage);

#endif
