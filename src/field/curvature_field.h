// A guide field along the lines of curvature of a surface.
#ifndef RAMIFY_FIELD_CURVATURE_FIELD_H
#define RAMIFY_FIELD_CURVATURE_FIELD_H

#include "base/mesh.h"
#include "field/point_tree.h"

typedef struct CurvatureField {
    PointTree tree;  // of the surface's vertices
    Vec3 *direction; // owned; per vertex: unit, of either sign; zero where all directions are alike
} CurvatureField;

// Directions of the greatest (least: of the least) principal curvature at the vertices of a surface
// of triangles with normals: curvature tensors of the faces from the normals' differences along
// their edges, averaged around each vertex (Rusinkiewicz 2004). Convex is positive. Clear with
// curvature_field_free, also on failure.
bool curvature_field_init(CurvatureField *field, const Mesh *surface, bool least, Error *e);
void curvature_field_free(CurvatureField *field);

// The direction at the vertex nearest to p, turned to the side of `toward`. Thread-safe.
Vec3 curvature_field_at(const CurvatureField *field, Vec3 p, Vec3 toward);

#endif
