#include "scene/estimate.h"

#include "base/memory.h"
#include "base/random.h"
#include "image/image.h"
#include "render/film.h"
#include "render/integrator.h"
#include "render/probe.h"
#include "render/renderer.h"
#include "render/world.h"
#include "scene/build.h"
#include "scene/needs.h"
#include "scene/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

// Encoding files, in units of the time in which a picture is developed without denoising.
#define PNG_ENCODING 2.0
#define EXR_ENCODING 4.0

enum { ROUGH_SAMPLES = 16 }; // previews of fewer samples are denoised

// Processor seconds a pixel.
typedef struct PixelCosts {
    double plain, clean; // developing it, without and with denoising
} PixelCosts;

static double seconds_of(int who)
{
    struct rusage usage;
    if (getrusage(who, &usage) != 0) {
        return 0.0;
    }
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

// Processor seconds that this process and its children have taken.
static double processor_seconds(void)
{
    return seconds_of(RUSAGE_SELF) + seconds_of(RUSAGE_CHILDREN);
}

// Bytes that are resident now; 0 if the system does not tell.
static double resident_bytes(void)
{
    FILE *stream = fopen("/proc/self/statm", "r");
    double pages = 0.0;
    if (stream) {
        if (fscanf(stream, "%*s %lf", &pages) != 1) {
            pages = 0.0;
        }
        fclose(stream);
    }
    return pages * (double)sysconf(_SC_PAGESIZE);
}

double scene_memory_built(const Scene *scene)
{
    return fmax((double)memory_peak(), resident_bytes() + scene_film_memory(scene));
}

// Some rows of a noisy picture of a grey surface: as wide as the picture, because the denoiser's
// share of the caches depends on that.
static Film *make_sample(int width, Error *e)
{
    enum { ROWS = 48, MOST = 2048 };
    width = width < MOST ? width : MOST;
    Film *film = film_new(width, ROWS, e);
    for (int i = 0; film && i < width * ROWS; i++) {
        film->color[i] = vec3_splat(0.2f + 0.1f * random_unit(random_key(1, (uint64_t)i)));
        film->albedo[i] = vec3_splat(0.5f);
        film->normal[i] = vec3(0, 0, 1);
        film->alpha[i] = film->depth[i] = film->hits[i] = 1.0f;
        film->variance[i] = 0.001f;
        film->samples[i] = 16.0f;
    }
    return film;
}

static double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// Processor seconds in which a pixel is developed: by one thread, because several would spend more
// of so short a time on waiting for each other than with a whole picture.
static bool develop(const Scene *scene, bool denoise, const Run *run, double *seconds, Error *e)
{
    Film *film = make_sample(scene->film.width, e);
    Image *image = NULL;
    double start = thread_seconds();
#pragma omp parallel num_threads(2) // in which further parallel regions have one thread
#pragma omp master
    {
        image = film ? picture_develop(scene, film, denoise, run, e) : NULL;
        *seconds = thread_seconds() - start;
    }
    *seconds /= image ? (double)image->width * image->height : 1.0;
    film_free(film);
    image_free(image);
    return image;
}

// Adds what tracing takes and the previews that are written meanwhile. traced, all: pixels of the
// crop and of the picture. most: processor seconds that tracing may take.
static void add_passes(Estimate *estimate, const Scene *scene, const PathCosts *costs,
                       const PixelCosts *pixel, double traced, double all, double most)
{
    int first = scene->render.first_sample, samples = render_end(&scene->render);
    double encode = all * PNG_ENCODING * pixel->plain;
    double now = traced / 16.0 * probe_pass_seconds(costs, 0, 1) + all * pixel->plain + encode;
    double due = 0.0;                                    // of the next preview
    estimate->preview = samples > first + 1 ? now : 0.0; // the first look
    for (int done = first, end; done < samples && estimate->trace < most; done = end) {
        end = integrator_pass_end(done, samples);
        double pass = traced * probe_pass_seconds(costs, done, end);
        estimate->trace += pass;
        now += pass;
        if ((end & (end - 1)) == 0 && end < samples && now >= due) {
            bool denoised = scene->denoise || end < ROUGH_SAMPLES;
            double preview = all * (denoised ? pixel->clean : pixel->plain) + encode;
            estimate->preview += preview;
            now += preview;
            due = 2.0 * now;
        }
    }
    estimate->trace = fmin(estimate->trace, most);
}

static bool estimate_picture(const Scene *scene, const Renderer *renderer, const Run *run,
                             Estimate *estimate, Error *e)
{
    PathCosts costs;
    PixelCosts pixel;
    if (!renderer_probe(renderer, run, &costs, e) || !develop(scene, false, run, &pixel.plain, e)) {
        return false;
    }
    pixel.clean = pixel.plain;
    // a denoiser that is missing matters only to previews if the scene does not ask for it
    if (!develop(scene, true, run, &pixel.clean, scene->denoise ? e : NULL) && scene->denoise) {
        return false;
    }
    const FilmParams *film = &scene->film;
    PixelBox crop = film_crop_pixels(film->width, film->height, film->crop);
    double traced = (double)(crop.x1 - crop.x0) * (crop.y1 - crop.y0),
           all = (double)film->width * film->height;
    const RenderParams *render = &scene->render;
    double most = render->max_seconds > 0.0 ? run->threads * render->max_seconds : (double)INFINITY;
    estimate->paths = (int64_t)traced * render->samples;
    estimate->write = all * ((scene->denoise ? pixel.clean : pixel.plain) +
                             (PNG_ENCODING + EXR_ENCODING) * pixel.plain);
    add_passes(estimate, scene, &costs, &pixel, traced, all, most);
    estimate->memory = scene_memory_built(scene);
    return true;
}

bool scene_estimate(const Scene *scene, const char *isa, double limit, const Run *run,
                    Estimate *estimate, Error *e)
{
    *estimate = (Estimate){0};
    double begin = processor_seconds();
    bool sound = scene_limit_memory(scene, limit, 0.0, e) &&
                 image_files_check(e); // loads what will write the picture
    double start = processor_seconds();
    World *world = sound ? scene_build(scene, run, NULL, e) : NULL;
    double grown = processor_seconds();
    Renderer *renderer = world ? renderer_new(world, isa, run, e) : NULL;
    estimate->grow = grown - start;
    estimate->build = processor_seconds() - grown;
    bool done = renderer && estimate_picture(scene, renderer, run, estimate, e) &&
                scene_limit_memory(scene, limit, estimate->memory, e);
    estimate->write += start - begin;
    renderer_free(renderer);
    world_free(world);
    return done;
}
