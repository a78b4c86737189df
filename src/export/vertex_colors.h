// Procedural colours at the vertices: what other programs can show of a pattern.
#ifndef RAMIFY_EXPORT_VERTEX_COLORS_H
#define RAMIFY_EXPORT_VERTEX_COLORS_H

#include "base/run.h"
#include "export/export.h"
#include "mesh/geometry.h"
#include "render/material/material.h"

// Were colours of patterns asked for, and has the material a pattern?
bool vertex_colors_wanted(const ExportOptions *options, const Material *material);

// The colour (reflectance, linear Rec. 709) that the part's material with its pattern has at each
// vertex of its mesh or each point of its curves, in their order; details finer than the faces
// around a vertex fade into their mean. Of an instanced part: without the variation between
// instances. The caller frees it. ERROR_MEMORY, ERROR_CANCELLED.
Vec3 *vertex_colors(const World *world, const Part *part, const Run *run, Error *e);

#endif
