// Converts round curves to closed tubes of triangles, for formats without curves.
#ifndef RAMIFY_MESH_CURVE_TUBES_H
#define RAMIFY_MESH_CURVE_TUBES_H

#include "base/mesh.h"
#include "mesh/curves.h"

enum { CURVE_TUBE_SIDES = 6, CURVE_TUBE_SIDES_MOST = 64 };

// Counts the vertices and triangles of the tubes of curves first .. first + count - 1.
void curve_tubes_count(const CurveSet *curves, int64_t first, int64_t count, int sides,
                       int64_t *vertices, int64_t *triangles);

// Builds those tubes as one mesh of triangles with normals, uv, radius and birth. Each curve is a
// closed tube facing outward: at every point a ring of `sides` (3 .. CURVE_TUBE_SIDES_MOST)
// vertices on the curve's surface, and at either end a pointed cap as long as the radius, so that
// the tube lies inside the round curve that the ray tracer sees (except at bends sharper than a
// radius). uv is as on skins (skin/skin.h): metres around, mirrored, and along. Radii below a
// hundredth of the curve's largest are raised to that, so that every triangle has an area. NULL and
// e when out of memory, or ERROR_INPUT for 2^32 vertices and more. The caller frees it with
// mesh_free.
Mesh *curve_tubes(const CurveSet *curves, int64_t first, int64_t count, int sides, Error *e);

// Spreads a value per curve point (of_point: for the whole set) to the vertices of those tubes.
void curve_tubes_spread(const CurveSet *curves, int64_t first, int64_t count, int sides,
                        const float *of_point, float *of_vertex);

#endif
