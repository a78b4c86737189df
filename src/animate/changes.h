// A growing list of changes to a scene. It owns the texts.
#ifndef RAMIFY_ANIMATE_CHANGES_H
#define RAMIFY_ANIMATE_CHANGES_H

#include "scene/scene.h"

typedef struct Changes {
    SceneChange *item;
    int64_t count, capacity;
} Changes;

void changes_clear(Changes *changes);

// Appends a change, copying path and value; source is borrowed.
bool changes_add(Changes *changes, const SceneChange *change, Error *e);

// Appends path = one number, or [a, b, ...], written so that the doubles read back unchanged.
bool changes_add_numbers(Changes *changes, const SceneChange *at, const double *value, int count,
                         Error *e);

#endif
