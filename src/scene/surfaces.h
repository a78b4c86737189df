// The surfaces of a scene's objects, each made once for all objects that are clear of it or grow
// over it.
#ifndef RAMIFY_SCENE_SURFACES_H
#define RAMIFY_SCENE_SURFACES_H

#include "mesh/geometry.h"
#include "render/accel/nearest.h"
#include "scene/scene.h"
#include "shape/envelope.h"

typedef struct Surfaces Surfaces;

// placed: geometry of the scene, in which the parts of an object are found if it has been placed;
// NULL = none is placed. Both are borrowed. Free with surfaces_free.
Surfaces *surfaces_new(const Scene *scene, const Geometry *placed, Error *e);
void surfaces_free(Surfaces *surfaces); // NULL is fine

// The surface of object number index; builds the object if it is not placed. *size: m, diagonal of
// its bounds. Owned by the surfaces. NULL and e on failure.
const Nearest *surfaces_of(Surfaces *surfaces, int index, float *size, const Run *run, Error *e);

// The same surface to be grown over: its meshes. Owned by the surfaces. NULL and e on failure:
// ERROR_INPUT if the object has no meshes.
const ShapeSurface *surfaces_over(Surfaces *surfaces, int index, const Run *run, Error *e);

// Its heights if it is a terrain that surfaces_over has found or built; else NULL. Owned by the
// surfaces or by the part that shows it.
const HeightField *surfaces_land(const Surfaces *surfaces, int index);

// The objects in an order in which obstacles and surfaces come before the objects that are clear of
// them or grow over them, and otherwise as in the scene. order: object_count numbers.
bool surfaces_order(const Scene *scene, int *order, Error *e);

#endif
