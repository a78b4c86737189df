// What follows from other keys where the file leaves a key at 0: notes for readers.
#ifndef RAMIFY_SCENE_SETTLE_H
#define RAMIFY_SCENE_SETTLE_H

#include "config/node.h"
#include "scene/scene.h"

// Notes at the numbers that are 0 in the resolved document, but something else in what the object's
// kind makes of them, what that is. The numbers themselves stay, so that the text can be read
// again.
bool settle_notes(const Scene *scene, Node *document, Arena *arena, Error *e);

#endif
