// Vertex colours: procedural patterns for other programs.
#ifndef RAMIFY_EXPORT_VERTEX_COLORS_H
#define RAMIFY_EXPORT_VERTEX_COLORS_H

#include "base/run.h"
#include "export/export.h"
#include "mesh/geometry.h"
#include "render/material/material.h"

// Do the options ask for pattern colours, and has the material a pattern?
bool vertex_colors_wanted(const ExportOptions *options, const Material *material);

// The reflectance (linear Rec. 709) of the part's material with its pattern at each vertex of its
// mesh or point of its curves, in their order. Details finer than the faces around a vertex fade
// into their mean. An instanced part gets no variation between instances. The caller frees it.
// ERROR_MEMORY, ERROR_CANCELLED.
Vec3 *vertex_colors(const World *world, const Part *part, const Run *run, Error *e);

#endif
