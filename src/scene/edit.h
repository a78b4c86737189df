// Changes values in the text of a scene file and keeps the rest: comments, layout, order.
#ifndef RAMIFY_SCENE_EDIT_H
#define RAMIFY_SCENE_EDIT_H

#include "scene/scene.h"

// The text of the scene's file with its overrides and the changes in place, as heap text. Values
// that the file has are replaced, others are added to their mapping. *whole: false if the text
// cannot hold the changes this way (a value comes from an alias, an override replaces a list); the
// text is then the changed scene with all values written out, without comments.
char *scene_edited_text(const Scene *scene, const SceneChange *changes, int count, bool *whole,
                        Error *e);

#endif
