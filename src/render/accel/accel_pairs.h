// Triangles joined to quads. Embree keeps quads and triangles in separate trees, and every ray goes
// through both; beside quads, triangles therefore trace faster as quads.
#ifndef RAMIFY_RENDER_ACCEL_ACCEL_PAIRS_H
#define RAMIFY_RENDER_ACCEL_ACCEL_PAIRS_H

#include "base/mesh.h"

typedef struct Pairs {
    uint32_t *corner; // 4 for each quad, owned
    uint32_t *face;   // for each quad: number of its first triangle and how both lie in it, owned
    int64_t count;
} Pairs;

// Joins each triangle with the next if they share an edge; others become quads with two equal
// corners. Leaves *pairs zero if too few triangles have a partner, or the mesh is too large.
bool pairs_new(Pairs *pairs, const Mesh *mesh, Error *e);
void pairs_clear(Pairs *pairs);

// Turns a hit of Embree's quad into that of a triangle: its number, and (u, v) in it.
uint32_t pairs_triangle(uint32_t face, float *u, float *v);

#endif
