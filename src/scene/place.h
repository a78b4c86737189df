// Locates values in the scene file, for errors that are found only while the scene is grown, built
// or rendered.
#ifndef RAMIFY_SCENE_PLACE_H
#define RAMIFY_SCENE_PLACE_H

#include "scene/scene.h"

// Sets the error's place to that of its value: `path` (as in --set; "" = the scene), then the
// error's key below it, down to the deepest node that the file or an override names. A place in
// another file (a line of an SWC) is kept; a file without a line is added to the message.
// ERROR_CANCELLED gets no place. Call once per error. Returns false.
bool scene_fail_at(const Scene *scene, const char *path, Error *e);

// The same for object number index; the error's key belongs to the mapping of its kind. The message
// names the object.
bool scene_fail_object(const Scene *scene, int index, Error *e);

#endif
