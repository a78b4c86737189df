// The attractors of a scene's objects, for export.
#ifndef RAMIFY_SCENE_EXPORT_POINTS_H
#define RAMIFY_SCENE_EXPORT_POINTS_H

#include "scene/scene.h"
#include "shape/points.h"

// Grows object number index, whose kind keeps its attractors, and returns those left at the scene's
// time, in scene space. Free with points_free.
PointSet *scene_points(const Scene *scene, int index, const Run *run, Error *e);

#endif
