// Growth of objects among obstacles, or in a contest: each makes one step in turn and sees all
// nodes that the others have made so far (Horiuchi et al., the battle for territory).
#ifndef RAMIFY_SCENE_RIVALS_H
#define RAMIFY_SCENE_RIVALS_H

#include "objects/kind.h"
#include "scene/obstacles.h"

typedef struct Rival {
    const Kind *kind;
    const void *params;   // in the object's own space
    Recipe recipe;        // its room is set here
    Transform to_scene;   // a rotation and a translation
    Obstacles *obstacles; // NULL = none
    float gap;            // m, to the others' nodes
    Grown whole;          // the result, owned by the caller
    Error error;
} Rival;

// Grows all rivals; one alone has obstacles only. Each recipe runs in a thread of its own, but only
// one at a time, with all threads of its run, so the result depends on the order of the rivals
// alone. False if one failed: failed is its index and its error tells why.
bool rivals_grow(Rival *rival, int count, int *failed);

#endif
