#include "animate/finish.h"

#include "animate/checkpoint.h"
#include "base/memory.h"
#include "scene/picture.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct Finisher {
    bool busy;
    pthread_t thread;
    char *file;   // owned
    Scene *scene; // owned
    const Film *film;
    char mark[64];
    int threads;
    bool done;
    Error e;
};

Finisher *finisher_new(Error *e)
{
    return memory_alloc_zero(1, sizeof(Finisher), e);
}

void finisher_free(Finisher *finisher)
{
    if (finisher) {
        finisher_wait(finisher, NULL);
        free(finisher);
    }
}

static void *finish(void *user)
{
    Finisher *f = user;
    Run run = run_default();
    run.threads = f->threads;
    f->done = picture_write_marked(f->file, f->scene, f->film, f->mark, &run, &f->e);
    if (f->done) {
        checkpoint_remove(f->file);
    }
    return NULL;
}

bool finisher_begin(Finisher *f, char *file, Scene *scene, const Film *film, const char *mark,
                    int threads, Error *e)
{
    f->file = file;
    f->scene = scene;
    f->film = film;
    f->threads = threads;
    f->done = false;
    f->e = (Error){0};
    snprintf(f->mark, sizeof f->mark, "%s", mark);
    f->busy = pthread_create(&f->thread, NULL, finish, f) == 0;
    if (!f->busy) { // if the thread could not be created, do it here
        finish(f);
    }
    return f->busy || finisher_wait(f, e);
}

bool finisher_wait(Finisher *f, Error *e)
{
    if (f->busy) {
        pthread_join(f->thread, NULL);
        f->busy = false;
    }
    bool done = !f->file || f->done;
    if (!done && e) {
        *e = f->e;
    }
    free(f->file);
    scene_free(f->scene);
    f->file = NULL;
    f->scene = NULL;
    return done;
}
