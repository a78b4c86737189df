// Vertices of a mesh for files: transformed, with normals and with the colours of the material's
// pattern.
#ifndef RAMIFY_EXPORT_VERTEX_H
#define RAMIFY_EXPORT_VERTEX_H

#include "base/mesh.h"
#include "export/export.h"
#include "mesh/geometry.h"
#include "render/material/material.h"

typedef struct ExportVertex {
    Vec3 position, normal; // the normal is unit
    Vec2 uv;
    float radius, birth;
    float glow;  // factor on the radiance of an emitting material
    Vec3 color;  // linear, 0..1: pattern and variation between instances; without textures
    Vec3 growth; // EXPORT_COLORS_GROWTH
} ExportVertex;

enum { EXPORT_WANTS_NORMALS = 1, EXPORT_WANTS_COLORS = 2 };

// A mesh prepared for that. mesh and material are borrowed.
typedef struct ExportSurface {
    const Mesh *mesh;
    const Material *material;
    unsigned wants;
    float largest_radius; // m: scale of the green of growth; 0 = no green
    const float *glow;    // of each vertex; borrowed; NULL = 1
    Vec3 *normal;         // owned: where the mesh has none and they are wanted; else NULL
    uint32_t *face;       // owned: some face of each vertex, for colours; else NULL
} ExportSurface;

// wants: EXPORT_WANTS_NORMALS makes smooth normals if the mesh has none. Unwanted normals are (0,
// 1, 0), unwanted colours the material's own.
bool export_surface_prepare(ExportSurface *surface, const Mesh *mesh, const Material *material,
                            unsigned wants, Error *e);
void export_surface_clear(ExportSurface *surface);

// Writes vertices first .. first + count - 1 to out. place: NULL = identity. look: of the instance;
// a negative variation = none, for a mesh that all instances share.
void export_surface_vertices(const ExportSurface *surface, const Transform *place,
                             InstanceLook look, int64_t first, int64_t count, int threads,
                             ExportVertex *out);

// dP/du and dP/dv of the triangle of these vertices; two of its edges if it has no uv.
void export_tangents(const Mesh *mesh, const uint32_t corner[3], Vec3 *u, Vec3 *v);

// True when the transform turns faces inside out.
bool export_is_mirror(const Transform *place);

// The triangles of a face, split as the ray tracer does: one, or (0, 1, 3) and (2, 3, 1) of a quad;
// reversed when mirrored. Returns their number.
int export_face_triangles(const Mesh *mesh, int64_t face, bool mirrored, uint32_t corner[6]);

// Linear 0..1 as 8-bit sRGB.
uint8_t export_srgb8(float linear);

#endif
