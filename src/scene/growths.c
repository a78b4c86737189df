#include "scene/growths.h"

#include "base/memory.h"

#include <pthread.h>
#include <stdlib.h>

struct Growths {
    Grown *of; // owned
    int count;
    pthread_mutex_t lock; // recursive: an obstacle of one contest may belong to another
};

static bool make_lock(Growths *growths, Error *e)
{
    pthread_mutexattr_t kind;
    if (pthread_mutexattr_init(&kind) != 0) {
        return error_set(e, ERROR_MEMORY, "no lock for the scene's growths can be made");
    }
    bool made = pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE) == 0 &&
                pthread_mutex_init(&growths->lock, &kind) == 0;
    pthread_mutexattr_destroy(&kind);
    return made || error_set(e, ERROR_MEMORY, "no lock for the scene's growths can be made");
}

Growths *growths_new(int objects, Error *e)
{
    Growths *growths = memory_alloc_zero(1, sizeof *growths, e);
    if (!growths) {
        return NULL;
    }
    growths->count = objects;
    growths->of = memory_alloc_zero(objects, sizeof *growths->of, e);
    if (!growths->of || !make_lock(growths, e)) {
        free(growths->of);
        free(growths);
        return NULL;
    }
    return growths;
}

void growths_free(Growths *growths)
{
    if (growths) {
        for (int i = 0; i < growths->count; i++) {
            grown_clear(&growths->of[i]);
        }
        pthread_mutex_destroy(&growths->lock);
        free(growths->of);
        free(growths);
    }
}

Grown *growths_open(Growths *growths)
{
    pthread_mutex_lock(&growths->lock);
    return growths->of;
}

void growths_close(Growths *growths)
{
    pthread_mutex_unlock(&growths->lock);
}
