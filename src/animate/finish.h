// Develops and writes a picture in a thread, while the next one is traced.
#ifndef RAMIFY_ANIMATE_FINISH_H
#define RAMIFY_ANIMATE_FINISH_H

#include "render/film.h"
#include "scene/scene.h"

typedef struct Finisher Finisher;

Finisher *finisher_new(Error *e);
void finisher_free(Finisher *finisher); // waits; NULL is fine

// Starts writing a film of a scene (see picture_write_marked). Takes ownership of file and scene,
// even on failure; the film must not change until finisher_wait. No other write may be in progress.
bool finisher_begin(Finisher *finisher, char *file, Scene *scene, const Film *film,
                    const char *mark, int threads, Error *e);

// Waits for the write in progress, if any. False and e when it failed.
bool finisher_wait(Finisher *finisher, Error *e);

#endif
