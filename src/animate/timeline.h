// The tracks of a scene's `animation:`, prepared for evaluation at any time.
#ifndef RAMIFY_ANIMATE_TIMELINE_H
#define RAMIFY_ANIMATE_TIMELINE_H

#include "animate/changes.h"

typedef struct Timeline Timeline;

// animation: borrowed; NULL = no tracks. Numbers are read and written in C-locale notation: callers
// of this and of timeline_add set the locale. ERROR_MEMORY.
Timeline *timeline_new(const SceneAnimation *animation, Error *e);
void timeline_free(Timeline *timeline); // NULL is fine

// Appends the tracks' values at a time, 0..1.
bool timeline_add(const Timeline *timeline, double time, Changes *changes, Error *e);

// Time of frame i of `frames`: i / frames in a loop, else i / (frames - 1).
double frame_time(int frame, int frames, bool loop);

#endif
