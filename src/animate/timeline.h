// The tracks of a scene's `animation:` made ready to be asked for any time.
#ifndef RAMIFY_ANIMATE_TIMELINE_H
#define RAMIFY_ANIMATE_TIMELINE_H

#include "animate/changes.h"

typedef struct Timeline Timeline;

// animation: borrowed; NULL = nothing changes. Numbers are read and written in the C locale's
// spelling: callers of this and of timeline_add see to the locale. ERROR_MEMORY.
Timeline *timeline_new(const SceneAnimation *animation, Error *e);
void timeline_free(Timeline *timeline); // NULL is fine

// Adds what the tracks say at a time, 0..1.
bool timeline_add(const Timeline *timeline, double time, Changes *changes, Error *e);

// When frame i of `frames` is: i / frames in a loop, else i / (frames - 1).
double frame_time(int frame, int frames, bool loop);

#endif
