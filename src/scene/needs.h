// What a scene will take in memory, told before anything is made of it: the needs of its objects
// (objects/common/needs.h) and of its film.
#ifndef RAMIFY_SCENE_NEEDS_H
#define RAMIFY_SCENE_NEEDS_H

#include "scene/scene.h"

// Bytes that rendering the scene will take in all.
double scene_memory(const Scene *scene);

// Refuses a scene, or one object of it (-1 = all), that needs more than there is, whatever is true
// of the estimate: ERROR_INPUT with file, line and column of the largest need's key.
bool scene_check_memory(const Scene *scene, int object, Error *e);

#endif
