// Estimates the memory that a scene will need, before it is built: that of its objects
// (objects/common/needs.h) and of its film.
#ifndef RAMIFY_SCENE_NEEDS_H
#define RAMIFY_SCENE_NEEDS_H

#include "scene/scene.h"

// Total number of bytes that rendering the scene will need.
double scene_memory(const Scene *scene);

// Bytes that its film takes, and developing and writing it.
double scene_film_memory(const Scene *scene);

// Refuses a scene that needs more than `limit` bytes of memory (0 = no limit): ERROR_INPUT with
// file, line and column of the key with the largest need, and the value that would do. measured:
// bytes that it takes, once it is built; 0 = not built, then only one that certainly needs more is
// refused.
bool scene_limit_memory(const Scene *scene, double limit, double measured, Error *e);

// Refuses a scene, or one object of it (-1 = all), that certainly needs more memory than is
// available: ERROR_INPUT with file, line and column of the key with the largest need.
bool scene_check_memory(const Scene *scene, int object, Error *e);

#endif
