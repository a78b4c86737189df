// Land whose mesh holds its copies, too, each with ground and water of its own: what lies at a
// place in plan. Private to this folder.
#ifndef RAMIFY_OBJECTS_SCATTER_GROUND_H
#define RAMIFY_OBJECTS_SCATTER_GROUND_H

#include "shape/envelope.h"

typedef struct ScatterGround ScatterGround;

// Of a surface with copies in its mesh. land: are places on its ground to be found, not water
// alone? Free with scatter_ground_free. ERROR_MEMORY.
ScatterGround *scatter_ground_new(const ShapeSurface *surface, bool land, Error *e);
void scatter_ground_free(ScatterGround *ground); // NULL is fine

// Moves a place up or down onto the ground, of which it sets the unit normal; false: there is none.
bool scatter_ground_find(const ScatterGround *ground, Vec3 *p, Vec3 *normal);

// m, height of the land's water, as it is drawn, over or under a place; -INFINITY: there is none.
float scatter_ground_water(const ScatterGround *ground, Vec3 p);

#endif
