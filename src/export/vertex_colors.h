// Procedural colours at the vertices: what other programs can show of a pattern.
#ifndef RAMIFY_EXPORT_VERTEX_COLORS_H
#define RAMIFY_EXPORT_VERTEX_COLORS_H

#include "base/run.h"
#include "mesh/geometry.h"
#include "render/material/material.h"

typedef struct World World;

// The colour (reflectance, linear Rec. 709) that the part's material with its pattern has at each
// vertex of its mesh or each point of its curves, in their order; details finer than the faces
// around a vertex fade into their mean. Of an instanced part: without the variation between
// instances. The caller frees it. ERROR_MEMORY, ERROR_CANCELLED.
Vec3 *vertex_colors(const World *world, const Part *part, const Run *run, Error *e);

#endif
