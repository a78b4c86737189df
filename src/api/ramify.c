#include "ramify.h"

#include "base/memory.h"
#include "image/image.h"
#include "render/renderer.h"
#include "scene/build.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

// The public structs mirror ours, so that ours may change.
static bool hand_error(RamifyError *out, const Error *e)
{
    if (out) {
        *out =
            (RamifyError){.code = (RamifyErrorCode)e->code, .line = e->line, .column = e->column};
        memcpy(out->file, e->file, sizeof out->file);
        memcpy(out->message, e->message, sizeof out->message);
    }
    return false;
}

_Static_assert(sizeof((RamifyError){0}.file) == sizeof((Error){0}.file), "file names fit");
_Static_assert(sizeof((RamifyError){0}.message) == sizeof((Error){0}.message), "messages fit");
_Static_assert((int)RAMIFY_BAD_INPUT == (int)ERROR_INPUT && (int)RAMIFY_IO == (int)ERROR_IO &&
                   (int)RAMIFY_MEMORY == (int)ERROR_MEMORY &&
                   (int)RAMIFY_CANCELLED == (int)ERROR_CANCELLED &&
                   (int)RAMIFY_INTERNAL == (int)ERROR_INTERNAL,
               "codes are the same");

static Run run_of(const RamifyRun *run)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    Run own = {.threads = count < 1 ? 1 : (int)count};
    if (run) {
        own.threads = run->threads > 0 ? run->threads : own.threads;
        own.cancelled = run->cancelled;
        own.progress = run->progress;
        own.warn = run->warn;
        own.user = run->user;
    }
    return own;
}

const char *ramify_version(void)
{
    return RAMIFY_VERSION;
}

void ramify_error_format(const RamifyError *error, char *text, size_t size)
{
    Error e = {.code = (ErrorCode)error->code, .line = error->line, .column = error->column};
    memcpy(e.file, error->file, sizeof e.file);
    memcpy(e.message, error->message, sizeof e.message);
    error_format(&e, text, size > 1 << 20 ? 1 << 20 : (int)size);
}

// A RamifyScene is a Scene, a RamifyTree an OutTree, under a name of their own.
static const Scene *scene_of(const RamifyScene *scene)
{
    return (const Scene *)(const void *)scene;
}

static const OutTree *tree_of(const RamifyTree *tree)
{
    return (const OutTree *)(const void *)tree;
}

RamifyScene *ramify_scene_load(const char *file, const char *const *overrides, int override_count,
                               RamifyError *error)
{
    Error e = {0};
    Scene *scene = scene_read(file, overrides, override_count, &e);
    if (!scene) {
        hand_error(error, &e);
    }
    return (RamifyScene *)(void *)scene;
}

RamifyScene *ramify_scene_load_text(const char *text, size_t length, const char *name,
                                    const char *folder, const char *const *overrides,
                                    int override_count, RamifyError *error)
{
    Error e = {0};
    Scene *scene = scene_read_text(text, length, name, folder, overrides, override_count, &e);
    if (!scene) {
        hand_error(error, &e);
    }
    return (RamifyScene *)(void *)scene;
}

void ramify_scene_free(RamifyScene *scene)
{
    scene_free((Scene *)(void *)scene);
}

void ramify_scene_size(const RamifyScene *scene, int *width, int *height)
{
    *width = scene_of(scene)->film.width;
    *height = scene_of(scene)->film.height;
}

const char *ramify_scene_resolved(const RamifyScene *scene)
{
    return scene_of(scene)->resolved;
}

int ramify_scene_object_count(const RamifyScene *scene)
{
    return scene_of(scene)->object_count;
}

const char *ramify_scene_object_name(const RamifyScene *scene, int index)
{
    return scene_of(scene)->objects[index].name;
}

char *ramify_schema(RamifyError *error)
{
    Error e = {0};
    char *text = scene_schema_json(&e);
    if (!text) {
        hand_error(error, &e);
    }
    return text;
}

void ramify_free(void *memory)
{
    free(memory);
}

RamifyTree *ramify_grow(const RamifyScene *scene, int index, const RamifyRun *run,
                        RamifyError *error)
{
    Error e = {0};
    Run own = run_of(run);
    OutTree *tree = scene_grow_object(scene_of(scene), index, &own, &e);
    if (!tree) {
        hand_error(error, &e);
    }
    return (RamifyTree *)(void *)tree;
}

void ramify_tree_free(RamifyTree *tree)
{
    out_tree_free((OutTree *)(void *)tree);
}

int64_t ramify_tree_count(const RamifyTree *tree)
{
    return tree_of(tree)->count;
}

const float *ramify_tree_positions(const RamifyTree *tree)
{
    _Static_assert(sizeof(Vec3) == 3 * sizeof(float), "positions are plain triples");
    return &tree_of(tree)->position->x;
}

const int32_t *ramify_tree_parents(const RamifyTree *tree)
{
    return tree_of(tree)->parent;
}

const float *ramify_tree_radii(const RamifyTree *tree)
{
    return tree_of(tree)->radius;
}

const int32_t *ramify_tree_births(const RamifyTree *tree)
{
    return tree_of(tree)->birth;
}

static bool trace(const World *world, const Run *run, Film *film, RenderStats *stats, Error *e)
{
    Renderer *renderer = renderer_new(world, NULL, run, e);
    bool done = renderer && renderer_render(renderer, film, run, NULL, NULL, stats, e);
    renderer_free(renderer);
    return done;
}

bool ramify_render(const RamifyScene *scene, float *rgba, int *samples, const RamifyRun *run,
                   RamifyError *error)
{
    Error e = {0};
    Run own = run_of(run);
    RenderStats stats = {0};
    World *world = scene_build(scene_of(scene), &own, NULL, &e);
    Film *film = world ? film_new(world->film.width, world->film.height, &e) : NULL;
    bool done = film && trace(world, &own, film, &stats, &e);
    for (int64_t i = 0; done && i < (int64_t)film->width * film->height; i++) {
        float pixel[4] = {film->color[i].x, film->color[i].y, film->color[i].z, film->alpha[i]};
        memcpy(rgba + 4 * i, pixel, sizeof pixel);
    }
    film_free(film);
    world_free(world);
    if (samples) {
        *samples = stats.samples;
    }
    return done || hand_error(error, &e);
}

bool ramify_write_image(const RamifyScene *scene, const float *rgba, const char *file,
                        RamifyError *error)
{
    Error e = {0};
    const Scene *own = scene_of(scene);
    Image *image = image_new(own->film.width, own->film.height, 4, &e);
    if (!image) {
        return hand_error(error, &e);
    }
    memcpy(image->pixel, rgba,
           sizeof(float) * 4 * (size_t)own->film.width * (size_t)own->film.height);
    const char *dot = strrchr(file, '.');
    bool done;
    if (dot && strcasecmp(dot, ".exr") == 0) {
        ImageLayer layer = {"", "RGBA", image};
        done = image_write_exr(file, &layer, 1, NULL, &e);
    } else {
        Image *display = tone_map(image, &own->tone, &e);
        done = display && image_write_display(file, display, NULL, &e);
        image_free(display);
    }
    image_free(image);
    return done || hand_error(error, &e);
}
