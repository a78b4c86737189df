// Develops and writes one picture in a thread of its own, beside the tracing of the next.
#ifndef RAMIFY_ANIMATE_FINISH_H
#define RAMIFY_ANIMATE_FINISH_H

#include "render/film.h"
#include "scene/scene.h"

typedef struct Finisher Finisher;

Finisher *finisher_new(Error *e);
void finisher_free(Finisher *finisher); // waits; NULL is fine

// Begins to write a film of a scene (see picture_write_marked). Takes file and scene, also when it
// fails; the film must stay as it is until finisher_wait. Nothing else may be under way.
bool finisher_begin(Finisher *finisher, char *file, Scene *scene, const Film *film,
                    const char *mark, int threads, Error *e);

// Waits for what is under way, if anything. False and e when it failed.
bool finisher_wait(Finisher *finisher, Error *e);

#endif
