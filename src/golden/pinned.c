#include "golden/pinned.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/renderer.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/place.h"

#include <stdlib.h>
#include <string.h>

bool pinned_check(const Scene *scene, Error *e)
{
    const RenderParams *render = &scene->render;
    if (render->max_seconds > 0.0) {
        error_set(e, ERROR_INPUT,
                  "render.seconds is %g, which gives every machine its own number of samples; a "
                  "golden image needs 0",
                  render->max_seconds);
    } else if (render->max_noise > 0.0f) {
        error_set(e, ERROR_INPUT,
                  "render.noise is %g, so that noise decides where samples are taken; a golden "
                  "image needs 0",
                  (double)render->max_noise);
    } else {
        return true;
    }
    error_locate(e, scene->file, 0, 0);
    return false;
}

// Renders into film, or fails; an unfinished picture counts as a failure.
static bool trace(Renderer *renderer, Film *film, const Run *run, Error *e)
{
    RenderStats stats;
    return renderer_render(renderer, film, run, NULL, NULL, &stats, e) &&
           (!run_is_cancelled(run) || run_cancel_error(e));
}

static Image *color_of(const Film *film, Error *e)
{
    Image *image = image_new(film->width, film->height, 3, e);
    for (int64_t i = 0; image && i < (int64_t)film->width * film->height; i++) {
        memcpy(image->pixel + 3 * i, &film->color[i], sizeof(Vec3));
    }
    return image;
}

static Image *picture_of(const Film *film, Error *e)
{
    int64_t count = (int64_t)film->width * film->height;
    bool opaque = true;
    for (int64_t i = 0; i < count; i++) {
        opaque = opaque && film->alpha[i] >= 1.0f;
    }
    if (opaque) {
        return color_of(film, e);
    }
    Image *image = image_new(film->width, film->height, 4, e);
    for (int64_t i = 0; image && i < count; i++) {
        memcpy(image->pixel + 4 * i, &film->color[i], sizeof(Vec3));
        image->pixel[4 * i + 3] = film->alpha[i];
    }
    return image;
}

struct Pinned {
    uint64_t seed; // seed of the scene
    World *world;
    Renderer *renderer;
    Film *film;
};

Pinned *pinned_open(const Scene *scene, const char *isa, const Run *run, Error *e)
{
    Pinned *p = pinned_check(scene, e) ? memory_alloc_zero(1, sizeof *p, e) : NULL;
    if (!p) {
        return NULL;
    }
    p->seed = scene->render.seed;
    p->world = scene_build(scene, run, NULL, e);
    p->renderer = p->world ? renderer_new(p->world, isa, run, e) : NULL;
    if (p->world && !p->renderer) {
        scene_fail_at(scene, "", e);
    }
    p->film = p->renderer ? film_new(p->world->film.width, p->world->film.height, e) : NULL;
    if (!p->film) {
        pinned_close(p);
        return NULL;
    }
    return p;
}

void pinned_close(Pinned *p)
{
    if (p) {
        film_free(p->film);
        renderer_free(p->renderer);
        world_free(p->world);
        free(p);
    }
}

Image *pinned_render(const Scene *scene, const char *isa, const Run *run, Error *e)
{
    Pinned *p = pinned_open(scene, isa, run, e);
    Image *image = p && trace(p->renderer, p->film, run, e) ? picture_of(p->film, e) : NULL;
    pinned_close(p);
    return image;
}

static bool add_run(Pinned *p, const Run *run, NoisyPicture *picture, Error *e)
{
    Image *rendering = trace(p->renderer, p->film, run, e) ? color_of(p->film, e) : NULL;
    if (rendering) {
        noisy_picture_add(picture, rendering);
    }
    image_free(rendering);
    return rendering;
}

bool pinned_render_noisy(Pinned *p, uint64_t series, int runs, const Run *run,
                         NoisyPicture *picture, Error *e)
{
    bool done = noisy_picture_make(picture, p->film->width, p->film->height, e);
    uint64_t key = random_key(p->seed, series);
    for (int i = 0; done && i < runs; i++) {
        p->world->render.seed = random_key(key, (uint64_t)i);
        done = add_run(p, run, picture, e);
    }
    if (!done) {
        noisy_picture_clear(picture);
    }
    return done;
}

Image *pinned_develop(const Scene *scene, const Image *linear, Error *e)
{
    return tone_map(linear, NULL, &scene->tone, e);
}
