// The nearest surface of geometry: Embree's point queries over its triangles and round curves.
#ifndef RAMIFY_RENDER_ACCEL_NEAREST_H
#define RAMIFY_RENDER_ACCEL_NEAREST_H

#include "base/run.h"
#include "mesh/geometry.h"

typedef struct Nearest Nearest;

// Copies the meshes and curves of the geometry; instanced parts (leaves, grass) are left out. Free
// with nearest_free. ERROR_MEMORY.
Nearest *nearest_new(const Geometry *geometry, const Run *run, Error *e);
void nearest_free(Nearest *nearest); // NULL is fine

// Signed distance (m) from p to the nearest surface: negative inside a body, below an open sheet
// that faces up, and in a curve. `reach` (m, positive) if nothing is within it; a point deeper than
// `reach` gets -reach. *away: the unit direction in which the distance grows, zero if unknown. The
// result does not depend on the machine. Thread-safe.
float nearest_distance(const Nearest *nearest, Vec3 p, float reach, Vec3 *away);

// Moves p to the nearest point of the surfaces, however far, and sets the unit normal of the
// triangle or curve there; without surfaces it changes nothing. The result does not depend on the
// machine. Thread-safe.
void nearest_point(const Nearest *nearest, Vec3 *p, Vec3 *normal);

#endif
