// Where in the scene's file a value stands: for errors that show only while the scene is grown,
// built or rendered.
#ifndef RAMIFY_SCENE_PLACE_H
#define RAMIFY_SCENE_PLACE_H

#include "scene/scene.h"

// Gives an error the place of the value that it is about: of `path` (as in --set; "" = the scene)
// and below it of the error's key, as far down as the file or an override names anything. A place
// in another file (an SWC's line) stays; a file without a line goes into the message.
// ERROR_CANCELLED gets none. To be called once an error. Returns false.
bool scene_fail_at(const Scene *scene, const char *path, Error *e);

// The same for object number index; the error's key is one of its kind's mapping. The message names
// the object.
bool scene_fail_object(const Scene *scene, int index, Error *e);

#endif
