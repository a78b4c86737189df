#include "api/handles.h"

#include "base/memory.h"
#include "image/image.h"
#include "render/accel/accel.h"
#include "render/integrator.h"
#include "scene/picture.h"
#include "scene/picture_read.h"
#include "scene/place.h"

#include <stdlib.h>
#include <string.h>

// ---- films ----

RamifyFilm *ramify_film_new(int width, int height, RamifyError *error)
{
    Error e = {0};
    Film *film = film_new(width, height, &e);
    if (!film) {
        api_fail(error, &e);
    }
    return (RamifyFilm *)(void *)film;
}

void ramify_film_free(RamifyFilm *film)
{
    film_free((Film *)(void *)film);
}

RamifyFilm *ramify_film_read(const char *file, const RamifyScene *scene, const RamifyRun *run,
                             RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    Film *film = picture_read_film(file, scene_of(scene), false, &own, &e);
    if (!film) {
        api_fail(error, &e);
    }
    return (RamifyFilm *)(void *)film;
}

RamifyFilm *ramify_film_join(const char *const *files, int count, const RamifyScene *scene,
                             int64_t *missing, const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    int64_t left = 0;
    Film *film = picture_join(files, count, scene_of(scene), &left, &own, &e);
    if (!film) {
        api_fail(error, &e);
    }
    if (missing) {
        *missing = left;
    }
    return (RamifyFilm *)(void *)film;
}

const float *ramify_film_layer(const RamifyFilm *film, const char *name, int *channels)
{
    const Film *own = film_of(film);
    const struct {
        const char *name;
        const void *pixel;
        int channels;
    } layers[] = {{"color", own->color, 3},       {"alpha", own->alpha, 1},
                  {"albedo", own->albedo, 3},     {"normal", own->normal, 3},
                  {"depth", own->depth, 1},       {"position", own->position, 3},
                  {"object", own->object, 1},     {"samples", own->samples, 1},
                  {"variance", own->variance, 1}, {"denoised", own->denoised, 3}};
    for (size_t i = 0; i < sizeof layers / sizeof layers[0]; i++) {
        if (layers[i].pixel && strcmp(layers[i].name, name) == 0) {
            if (channels) {
                *channels = layers[i].channels;
            }
            return layers[i].pixel;
        }
    }
    return NULL;
}

void ramify_film_rgba(const RamifyFilm *film, float *rgba)
{
    picture_copy_rgba(film_of(film), rgba);
}

bool ramify_film_denoise(RamifyFilm *film, const RamifyScene *scene, const RamifyRun *run,
                         RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    return picture_denoise(scene_of(scene), (Film *)(void *)film, &own, &e) || api_fail(error, &e);
}

bool ramify_film_develop(const RamifyFilm *film, const RamifyScene *scene, bool denoise,
                         float *rgba, const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    Image *display = picture_develop(scene_of(scene), film_of(film), denoise, &own, &e);
    if (!display) {
        return api_fail(error, &e);
    }
    memcpy(rgba, display->pixel,
           sizeof(float) * 4 * (size_t)display->width * (size_t)display->height);
    image_free(display);
    return true;
}

bool ramify_film_noise(const RamifyFilm *film, const RamifyScene *scene, double *noise,
                       RamifyError *error)
{
    Error e = {0};
    return picture_noise(scene_of(scene), film_of(film), noise, &e) || api_fail(error, &e);
}

bool ramify_film_write(const RamifyFilm *film, const RamifyScene *scene, const char *file,
                       bool denoise, const RamifyRun *run, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    bool done =
        picture_is_exr(file)
            ? picture_write_exr(file, scene_of(scene), film_of(film), denoise, &own, &e)
            : picture_write_display(file, scene_of(scene), film_of(film), denoise, &own, &e);
    return done || api_fail(error, &e);
}

bool ramify_film_write_part(const RamifyFilm *film, const RamifyScene *scene, const char *file,
                            RamifyError *error)
{
    Error e = {0};
    return picture_write_part(file, scene_of(scene), film_of(film), NULL, &e) ||
           api_fail(error, &e);
}

bool ramify_write_image(const RamifyScene *scene, const float *rgba, const char *file,
                        RamifyError *error)
{
    Error e = {0};
    return picture_write_rgba(file, scene_of(scene), rgba, &e) || api_fail(error, &e);
}

bool ramify_image_check(const char *file, RamifyError *error)
{
    Error e = {0};
    return picture_check(file, &e) || api_fail(error, &e);
}

bool ramify_develop_check(const RamifyScene *scene, RamifyError *error)
{
    Error e = {0};
    const Scene *own = scene_of(scene);
    int oidn;
    bool sound = (!own->denoise || picture_find_denoiser(own, &oidn, NULL, &e)) &&
                 picture_check_color(own, &e);
    return sound || api_fail(error, &e);
}

// ---- rendering ----

bool ramify_check_isa(const char *isa, RamifyError *error)
{
    Error e = {0};
    return accel_check_isa(isa, &e) || api_fail(error, &e);
}

RamifyRenderer *ramify_renderer_new(const RamifyWorld *world, const char *isa, const RamifyRun *run,
                                    RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    Renderer *renderer = renderer_new(world->world, isa, &own, &e);
    if (!renderer) {
        scene_fail_at(world->scene, "", &e);
        api_fail(error, &e);
    }
    return (RamifyRenderer *)(void *)renderer;
}

void ramify_renderer_free(RamifyRenderer *renderer)
{
    renderer_free((Renderer *)(void *)renderer);
}

typedef struct PassCall {
    RamifyPass pass;
    void *user;
} PassCall;

static void call_pass(void *user, const Film *film, int samples)
{
    const PassCall *call = user;
    call->pass(call->user, (const RamifyFilm *)(const void *)film, samples);
}

bool ramify_renderer_look(RamifyRenderer *renderer, RamifyFilm *film, const RamifyRun *run,
                          RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    return renderer_look((Renderer *)(void *)renderer, (Film *)(void *)film, &own, &e) ||
           api_fail(error, &e);
}

static void fill_info(RamifyRenderInfo *info, const RenderStats *stats)
{
    if (info) {
        *info = (RamifyRenderInfo){.paths = stats->paths,
                                   .rays = stats->rays,
                                   .bytes = stats->memory,
                                   .seconds = stats->seconds,
                                   .samples = stats->samples};
    }
}

bool ramify_renderer_resume(RamifyRenderer *renderer, RamifyFilm *film, RamifyPass pass,
                            double every, void *user, const RamifyRun *run, RamifyRenderInfo *info,
                            RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    RenderStats stats = {0};
    PassCall call = {pass, user};
    bool done = renderer_resume((Renderer *)(void *)renderer, (Film *)(void *)film, &own,
                                pass ? call_pass : NULL, every, &call, &stats, &e);
    fill_info(info, &stats);
    return done || api_fail(error, &e);
}

bool ramify_renderer_render(RamifyRenderer *renderer, RamifyFilm *film, RamifyPass pass, void *user,
                            const RamifyRun *run, RamifyRenderInfo *info, RamifyError *error)
{
    Error e = {0};
    Run own = api_run(run);
    RenderStats stats = {0};
    PassCall call = {pass, user};
    bool done = renderer_render((Renderer *)(void *)renderer, (Film *)(void *)film, &own,
                                pass ? call_pass : NULL, &call, &stats, &e);
    fill_info(info, &stats);
    return done || api_fail(error, &e);
}

static void copy_vector(float to[3], Vec3 from)
{
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

static void fill_step(RamifyPathStep *to, const PathStep *from, const World *world)
{
    static const char *const ends[] = {[STEP_SURFACE] = "surface",
                                       [STEP_LAMP] = "lamp",
                                       [STEP_MEDIUM] = "medium",
                                       [STEP_OUTSIDE] = "outside"};
    to->end = ends[from->end];
    to->material = from->material >= 0 ? world->material[from->material].name : NULL;
    to->object = from->object;
    copy_vector(to->origin, from->origin);
    copy_vector(to->position, from->position);
    copy_vector(to->direction, from->direction);
    copy_vector(to->normal, from->normal);
    copy_vector(to->throughput, from->throughput);
    copy_vector(to->light, from->light);
}

int ramify_renderer_replay(RamifyRenderer *renderer, const RamifyWorld *world, int x, int y,
                           int sample, RamifyPathStep *step, int most, float color[3],
                           RamifyError *error)
{
    Error e = {0};
    Vec3 sum = vec3_splat(0.0f);
    PathStep *own = memory_alloc(most, sizeof *own, &e);
    int steps =
        own ? renderer_replay((Renderer *)(void *)renderer, x, y, sample, own, most, &sum, &e) : -1;
    if (steps < 0) {
        api_fail(error, &e);
    }
    for (int i = 0; i < steps; i++) {
        fill_step(&step[i], &own[i], world->world);
    }
    copy_vector(color, sum);
    free(own);
    return steps;
}

bool ramify_render(const RamifyScene *scene, float *rgba, int *samples, const RamifyRun *run,
                   RamifyError *error)
{
    RamifyRenderInfo info = {0};
    int width, height;
    ramify_scene_size(scene, &width, &height);
    RamifyWorld *world = ramify_build(scene, run, error);
    RamifyFilm *film = world ? ramify_film_new(width, height, error) : NULL;
    RamifyRenderer *renderer = film ? ramify_renderer_new(world, NULL, run, error) : NULL;
    bool done = renderer && ramify_renderer_render(renderer, film, NULL, NULL, run, &info, error);
    if (done) {
        ramify_film_rgba(film, rgba);
    }
    if (samples) {
        *samples = info.samples;
    }
    ramify_renderer_free(renderer);
    ramify_film_free(film);
    ramify_world_free(world);
    return done;
}
