// The unfinished frame of an animation, saved beside its picture: f-07.begun.exr for f-07.png.
#ifndef RAMIFY_ANIMATE_CHECKPOINT_H
#define RAMIFY_ANIMATE_CHECKPOINT_H

#include "base/run.h"
#include "base/save_clock.h"
#include "render/film.h"
#include "scene/scene.h"

#define CHECKPOINT_ENDING ".begun.exr"

// A frame that is being traced.
typedef struct Checkpoint {
    char *file;         // owned; NULL = nothing is saved
    const Scene *scene; // of the frame; borrowed, like the mark and the run
    const char *mark;   // see frame_mark
    const Run *run;     // is warned when saving fails
    SaveClock clock;
} Checkpoint;

// picture: the frame's file. every: s between savings; 0 = never. Errors: ERROR_MEMORY.
bool checkpoint_begin(Checkpoint *checkpoint, const char *picture, const Scene *scene,
                      const char *mark, double every, const Run *run, Error *e);
void checkpoint_clear(Checkpoint *checkpoint);

// The film that an earlier run has saved of this frame; the caller owns it. NULL if there is none
// with this mark, or with a warning if it cannot be read: the frame then starts anew.
Film *checkpoint_read(const Checkpoint *checkpoint);

// A RenderPass; user is the Checkpoint. Saves the film when it is time.
void checkpoint_pass(void *user, const Film *film, int samples);

// Saves the film now. A failure is a warning and ends further savings.
void checkpoint_save(Checkpoint *checkpoint, const Film *film);

// Removes what is saved of a picture that is complete.
void checkpoint_remove(const char *picture);

#endif
