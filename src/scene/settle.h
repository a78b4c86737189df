// The resolved text of a scene: every value it has, with notes on what follows from other keys
// where the file leaves a key at 0.
#ifndef RAMIFY_SCENE_SETTLE_H
#define RAMIFY_SCENE_SETTLE_H

#include "config/load.h"
#include "scene/scene.h"

// In the scene's arena. Numbers that are 0, but something else in what the object's kind makes of
// them, get a note what that is; they stay, so that the text can be read again. files: as they were
// loaded.
char *settle_write(const Scene *scene, const FileName *files, Error *e);

#endif
