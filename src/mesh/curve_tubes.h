// Round curves as closed tubes, for programs that know only meshes.
#ifndef RAMIFY_MESH_CURVE_TUBES_H
#define RAMIFY_MESH_CURVE_TUBES_H

#include "base/mesh.h"
#include "mesh/curves.h"

enum { CURVE_TUBE_SIDES = 6, CURVE_TUBE_SIDES_MOST = 64 };

// How many vertices and triangles the tubes of curves first .. first + count - 1 have.
void curve_tubes_count(const CurveSet *curves, int64_t first, int64_t count, int sides,
                       int64_t *vertices, int64_t *triangles);

// Those tubes as one mesh of triangles with normals, uv, radius and birth. Each curve is one closed
// tube that looks outward: a ring of `sides` (3 .. CURVE_TUBE_SIDES_MOST) corners on the curve's
// surface at every point, and a pointed cap as long as the radius at either end, so that it lies
// within the round curve that the ray tracer sees (but for bends sharper than a radius). uv is as
// on skins (skin/skin.h): metres around, mirrored, and along. A radius below a hundredth of the
// curve's largest is raised to that, so that no triangle is without area.
// NULL and e when memory is short, or with ERROR_INPUT for 2^32 vertices and more.
Mesh *curve_tubes(const CurveSet *curves, int64_t first, int64_t count, int sides, Error *e);

// What those curves have at their points (of_point: of all of the set's), at the vertices of their
// tubes.
void curve_tubes_spread(const CurveSet *curves, int64_t first, int64_t count, int sides,
                        const float *of_point, float *of_vertex);

#endif
