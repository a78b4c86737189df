// A height field as triangles: many where it is rough and near the eye, few where it is even or far
// away, and no cracks between (right-triangulated irregular network, Evans et al. 1997).
#ifndef RAMIFY_LAND_HEIGHT_MESH_H
#define RAMIFY_LAND_HEIGHT_MESH_H

#include "base/mesh.h"
#include "land/height_field.h"

typedef struct HeightMeshParams {
    float error;     // m: largest height error where there is no eye
    const Vec3 *eye; // in the field's space; NULL = the same error everywhere
    float view;      // with an eye: the error allowed is this share of the distance to it, if more
    float nearest;   // m: distances count as no less than this
    const uint8_t *keep; // of each sample: 1 = a corner, however even the land; NULL = none
} HeightMeshParams;

// Triangles over all of a square field whose side is a power of two cells (ERROR_INPUT otherwise).
// Normals come from the full field; uv are metres in the plane; Mesh.site holds the altitude (0..1
// between the lowest and the highest sample) and the wetness.
Mesh *height_mesh_new(const HeightField *field, const HeightMeshParams *params, Error *e);

// The height at any place of the mesh whose corners are all samples; beyond the rim that of the
// rim.
float height_mesh_finest_at(const HeightField *field, float x, float z);

#endif
