// The resolved text of a scene: all values, with notes that give the automatic value of keys that
// are 0.
#ifndef RAMIFY_SCENE_SETTLE_H
#define RAMIFY_SCENE_SETTLE_H

#include "config/load.h"
#include "scene/scene.h"

// Allocated in the scene's arena. A number that is 0 and that the object's kind replaces by an
// automatic value gets a comment with that value; it stays 0, so that the text can be read again.
// files: the list from the loader.
char *settle_write(const Scene *scene, const FileName *files, Error *e);

#endif
