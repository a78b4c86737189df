// Surfaces of other objects that an object's growth keeps clear of.
#ifndef RAMIFY_SCENE_OBSTACLES_H
#define RAMIFY_SCENE_OBSTACLES_H

#include "scene/surfaces.h"

typedef struct Obstacles Obstacles;

// Finds the objects that object number index of the scene is clear of; *obstacles is NULL if there
// are none. Borrows their surfaces. Free with obstacles_free.
bool obstacles_new(const Scene *scene, int index, Surfaces *surfaces, const Run *run,
                   Obstacles **obstacles, Error *e);
void obstacles_free(Obstacles *obstacles); // NULL is fine

// Distance (m) from p, in the scene, to the space that the nearest of them takes, surface and
// distance to be kept; negative inside. *away: the direction in which it grows. Thread-safe.
float obstacles_clearance(const Obstacles *obstacles, Vec3 p, Vec3 *away);

// Is p free, and within reach of those that it must be near?
bool obstacles_allow(const Obstacles *obstacles, Vec3 p);

#endif
