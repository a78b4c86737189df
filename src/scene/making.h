// An object on its way from its parameters to growth and geometry, in its own space.
#ifndef RAMIFY_SCENE_MAKING_H
#define RAMIFY_SCENE_MAKING_H

#include "scene/build.h"
#include "shape/deformation.h"

typedef struct Making {
    const Scene *scene;
    int index;
    const Kind *kind;
    OwnSpace own;
    const void *params;
    char label[128];
    Recipe recipe;
    Deformation *deformation; // NULL = none
    Carrier carrier;
    struct Surfaces *surfaces; // own ones; NULL = none, or the caller's are used
    Grown grown;
} Making;

// End with making_end, also on failure.
bool making_begin(Making *m, const Scene *scene, int index, const Run *run, Error *e);

// Grows the object, among its neighbours if it has any, and cuts it at the scene's time.
bool making_grow(Making *m, Shared shared, Error *e);

// Frees. Errors name the object and the place in the file. Returns done.
bool making_end(Making *m, bool done, Error *e);

#endif
