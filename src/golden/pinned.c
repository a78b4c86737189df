#include "golden/pinned.h"

#include "base/random.h"
#include "render/renderer.h"
#include "scene/build.h"

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

// Renders into film, or fails; a half-made picture is none.
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

// What both ways of rendering need.
typedef struct Studio {
    World *world;
    Renderer *renderer;
    Film *film;
} Studio;

static bool studio_open(Studio *s, const Scene *scene, const char *isa, const Run *run, Error *e)
{
    *s = (Studio){0};
    s->world = pinned_check(scene, e) ? scene_build(scene, run, NULL, e) : NULL;
    s->renderer = s->world ? renderer_new(s->world, isa, run, e) : NULL;
    s->film = s->renderer ? film_new(s->world->film.width, s->world->film.height, e) : NULL;
    return s->film;
}

static void studio_close(Studio *s)
{
    film_free(s->film);
    renderer_free(s->renderer);
    world_free(s->world);
}

Image *pinned_render(const Scene *scene, const char *isa, const Run *run, Error *e)
{
    Studio s;
    Image *image = NULL;
    if (studio_open(&s, scene, isa, run, e) && trace(s.renderer, s.film, run, e)) {
        image = picture_of(s.film, e);
    }
    studio_close(&s);
    return image;
}

static bool add_run(Studio *s, const Run *run, NoisyPicture *picture, Error *e)
{
    Image *rendering = trace(s->renderer, s->film, run, e) ? color_of(s->film, e) : NULL;
    if (rendering) {
        noisy_picture_add(picture, rendering);
    }
    image_free(rendering);
    return rendering;
}

bool pinned_render_noisy(const Scene *scene, const char *isa, uint64_t series, int runs,
                         const Run *run, NoisyPicture *picture, Error *e)
{
    Studio s;
    *picture = (NoisyPicture){0};
    bool done = studio_open(&s, scene, isa, run, e) &&
                noisy_picture_make(picture, s.film->width, s.film->height, e);
    uint64_t key = random_key(scene->render.seed, series);
    for (int i = 0; done && i < runs; i++) {
        s.world->render.seed = random_key(key, (uint64_t)i);
        done = add_run(&s, run, picture, e);
    }
    studio_close(&s);
    if (!done) {
        noisy_picture_clear(picture);
    }
    return done;
}

Image *pinned_develop(const Scene *scene, const Image *linear, Error *e)
{
    return tone_map(linear, &scene->tone, e);
}
