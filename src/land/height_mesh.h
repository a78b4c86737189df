// Meshes a height field adaptively: small triangles where it is rough and near the eye, large ones
// where it is smooth or far away, without cracks (right-triangulated irregular network, Evans
// 1997).
#ifndef RAMIFY_LAND_HEIGHT_MESH_H
#define RAMIFY_LAND_HEIGHT_MESH_H

#include "base/mesh.h"
#include "land/height_field.h"

typedef struct HeightMeshParams {
    float error;     // m: largest height error without an eye
    const Vec3 *eye; // in the field's space; NULL = uniform error
    float view;      // with an eye: the allowed error is this fraction of the distance to it, if
                     // larger
    float nearest;   // m: lower bound of distances
    const uint8_t *keep; // per sample: 1 = always a vertex; NULL = none
} HeightMeshParams;

// Triangulates a square field whose side is a power of two cells (else ERROR_INPUT). Normals come
// from the full field; uv are metres in the plane; Mesh.site holds the altitude (0..1 between the
// lowest and the highest sample) and the wetness; of braided rivers the age
// and the wetness, of sand (1 + wind) / 2. The caller frees it
// with mesh_free.
Mesh *height_mesh_new(const HeightField *field, const HeightMeshParams *params, Error *e);

// The normal of the land at a sample, and what Mesh.site holds there; low, high: of the whole land.
Vec3 height_mesh_normal(const HeightField *field, int column, int row);
Vec2 height_mesh_site(const HeightField *field, int64_t sample, float low, float high);

// Height of the mesh that uses all samples, at any point; outside the field, that of the rim.
float height_mesh_finest_at(const HeightField *field, float x, float z);

#endif
