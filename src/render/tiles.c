#include "render/tiles.h"

#include "base/color.h"
#include "base/memory.h"
#include "render/film_merge.h"
#include "render/world.h"

#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { TILE_SIZE = 16, LEAST_ADAPTIVE_SAMPLES = 16, LOOK_STEP = 4 };

typedef struct Tile {
    int x0, y0, x1, y1;
    int samples; // the next to take, of its pixel with the fewest
    bool quiet;  // its noise is below max_noise
} Tile;

typedef struct Job {
    const Tracer *tracer;
    Film *film;
    const Run *run;
    Tile *tile;
    int tile_count;
    int64_t pixels;
    int first, end; // samples that are to be taken: first .. end - 1
    double start;
    double call;      // run_seconds at which the pass is interrupted for a call; INFINITY = not
    pthread_t caller; // the thread that reports progress
    _Atomic int64_t rays, paths;
    _Atomic int64_t settled; // paths traced, or skipped by adaptive stopping
} Job;

// Adds samples begin .. end - 1 of the pixel to its sum. Waves are traced whole, also where the
// range begins or ends within one.
static void trace_pixel(const Tracer *tracer, int x, int y, int begin, int end, PathSum *sum)
{
    PathResult result[WAVE_SIZE];
    for (int from, to, k = begin; k < end; k = to) {
        integrator_wave(tracer, k, &from, &to);
        integrator_paths(tracer, x, y, from, to - from, result);
        path_sum_add(sum, result + (k - from), (to < end ? to : end) - k);
    }
}

// Number of the next sample of the pixel.
static int next_sample(const Job *job, int x, int y)
{
    return job->first + (int)job->film->samples[(int64_t)y * job->film->width + x];
}

// Renders the pixels of the tile up to sample `end` - 1. When cancelled, the remaining
// ones and the tile's count stay as they were; no further pass follows.
static void render_tile(Job *job, Tile *tile, int end)
{
    int64_t rays = 0, paths = 0;
    bool whole = true;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            int begin = next_sample(job, x, y);
            if (begin >= end) {
                continue; // of a film that was resumed
            }
            if (run_is_cancelled(job->run)) {
                whole = false;
                break;
            }
            PathSum paths_sum = {.samples = 0};
            PixelSum sum;
            int64_t pixel = (int64_t)y * job->film->width + x;
            trace_pixel(job->tracer, x, y, begin, end, &paths_sum);
            film_sum(job->film, pixel, &sum);
            pixel_sum_add(&sum, &paths_sum);
            film_set(job->film, pixel, &sum);
            rays += paths_sum.rays;
            paths += end - begin;
        }
    }
    job->rays += rays;
    job->paths += paths;
    if (whole && tile->samples < end) {
        tile->samples = end;
    }
}

static int most_samples(const Job *job, const Tile *tile)
{
    int most = 0;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            int own = next_sample(job, x, y);
            most = own > most ? own : most;
        }
    }
    return most;
}

// Mean over the tile of each pixel's relative standard error. The floor keeps black pixels from
// asking for samples for ever.
static float tile_noise(const Film *film, const Tile *tile)
{
    double sum = 0.0;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1; x++) {
            int64_t i = (int64_t)y * film->width + x;
            sum += (double)(sqrtf(film->variance[i]) / (luminance(film->color[i]) + 0.02f));
        }
    }
    return (float)(sum / ((double)(tile->x1 - tile->x0) * (tile->y1 - tile->y0)));
}

static bool must_stop(const Job *job)
{
    double limit = job->tracer->world->render.max_seconds;
    return run_is_cancelled(job->run) || (limit > 0.0 && run_seconds() - job->start > limit);
}

static void tell_progress(const Job *job)
{
    const RenderParams *params = &job->tracer->world->render;
    double done = (double)job->settled / ((double)job->pixels * (job->end - job->first));
    if (params->max_seconds > 0.0) {
        done = fmax(done, (run_seconds() - job->start) / params->max_seconds);
    }
    run_progress(job->run, "trace", fmin(done, 1.0));
}

// Is the tile, after a pass to `end` samples, smooth enough? A tile that has taken more in an
// earlier run was not.
static bool is_quiet(const Job *job, const Tile *tile, int end)
{
    float limit = job->tracer->world->render.max_noise;
    return limit > 0.0f && end >= LEAST_ADAPTIVE_SAMPLES && most_samples(job, tile) <= end &&
           tile_noise(job->film, tile) < limit;
}

// Renders the tiles from number *first on from `before` to `end` samples. When time is over it
// finishes the tiles in work, and all of the first pass, so that the picture is complete; when
// cancelled it stops at once; when a call is due it returns with *first at the next tile.
static void render_pass(Job *job, int before, int end, int *first)
{
    _Atomic int next = *first;
    _Atomic bool stop = false;
#pragma omp parallel num_threads(job->run->threads)
    {
        unsigned state = accel_thread_begin();
        // a tile that is taken is rendered, so that the pass can go on after the last one
        for (int i; !stop && (i = next++) < job->tile_count;) {
            Tile *tile = &job->tile[i];
            int64_t area = (int64_t)(tile->x1 - tile->x0) * (tile->y1 - tile->y0);
            job->settled += area * (end - before);
            if (!tile->quiet) {
                render_tile(job, tile, end);
                tile->quiet = is_quiet(job, tile, end);
            }
            stop = stop || run_is_cancelled(job->run) || (before > job->first && must_stop(job)) ||
                   run_seconds() > job->call;
            if (pthread_equal(pthread_self(), job->caller)) {
                tell_progress(job);
            }
        }
        accel_thread_end(state);
    }
    *first = next < job->tile_count ? next : job->tile_count;
}

static Tile *make_tiles(const FilmParams *film, int *count, int64_t *pixels, Error *e)
{
    PixelBox crop = film_crop_pixels(film->width, film->height, film->crop);
    int x0 = crop.x0, y0 = crop.y0, x1 = crop.x1, y1 = crop.y1;
    if (x0 >= x1 || y0 >= y1) {
        error_set(e, ERROR_INPUT, "the crop leaves no pixel; x0 < x1 and y0 < y1 are needed");
        return NULL;
    }
    int left = x0 - x0 % TILE_SIZE, top = y0 - y0 % TILE_SIZE; // as in the whole picture
    int columns = (x1 - left + TILE_SIZE - 1) / TILE_SIZE,
        rows = (y1 - top + TILE_SIZE - 1) / TILE_SIZE;
    *pixels = (int64_t)(x1 - x0) * (y1 - y0);
    *count = columns * rows;
    Tile *tile = memory_alloc_zero(*count, sizeof *tile, e);
    for (int i = 0; tile && i < *count; i++) {
        int x = left + i % columns * TILE_SIZE, y = top + i / columns * TILE_SIZE;
        tile[i] = (Tile){.x0 = x > x0 ? x : x0,
                         .y0 = y > y0 ? y : y0,
                         .x1 = x + TILE_SIZE < x1 ? x + TILE_SIZE : x1,
                         .y1 = y + TILE_SIZE < y1 ? y + TILE_SIZE : y1};
    }
    return tile;
}

// When the caller is told of a rendering.
typedef struct Calls {
    RenderPass *pass; // NULL = never
    double every;     // s, within passes; 0 = only after them
    void *user;
} Calls;

// Samples that every pixel has.
static int least_samples(const Job *job)
{
    int least = job->tile[0].samples;
    for (int i = 1; i < job->tile_count; i++) {
        least = job->tile[i].samples < least ? job->tile[i].samples : least;
    }
    return least - job->first;
}

static bool all_quiet(const Job *job)
{
    for (int i = 0; i < job->tile_count; i++) {
        if (!job->tile[i].quiet) {
            return false;
        }
    }
    return true;
}

// A pass, interrupted for calls.
static void render_whole_pass(Job *job, const Calls *calls, int before, int end)
{
    int first = 0;
    while (first < job->tile_count) {
        job->call = calls->every > 0.0 ? run_seconds() + calls->every : (double)INFINITY;
        render_pass(job, before, end, &first);
        if (run_is_cancelled(job->run) || (before > job->first && must_stop(job))) {
            return;
        }
        if (first < job->tile_count) {
            calls->pass(calls->user, job->film, least_samples(job));
        }
    }
}

static void render_passes(Job *job, const Calls *calls)
{
    int done = job->first;
    while (done < job->end && !(done > job->first && must_stop(job)) && !all_quiet(job)) {
        int before = done;
        int64_t paths = job->paths;
        done = integrator_pass_end(done, job->end);
        render_whole_pass(job, calls, before, done);
        bool power_of_two = (done & (done - 1)) == 0;
        if (calls->pass && job->paths > paths && (power_of_two || done == job->end) &&
            !run_is_cancelled(job->run)) {
            calls->pass(calls->user, job->film, done - job->first);
        }
    }
}

// What the tiles have of a film that is resumed.
static void count_samples(const Job *job)
{
    for (int i = 0; i < job->tile_count; i++) {
        Tile *tile = &job->tile[i];
        tile->samples = INT_MAX;
        for (int y = tile->y0; y < tile->y1; y++) {
            for (int x = tile->x0; x < tile->x1; x++) {
                int own = next_sample(job, x, y);
                tile->samples = own < tile->samples ? own : tile->samples;
            }
        }
    }
}

// Clears the pixels that a cancelled first pass did not reach: black and transparent.
static void clear_unseen(const Job *job)
{
    const PixelSum nothing = {.samples = 0};
    for (int i = 0; i < job->tile_count; i++) {
        const Tile *tile = &job->tile[i];
        for (int y = tile->y0; y < tile->y1 && tile->samples == job->first; y++) {
            for (int x = tile->x0; x < tile->x1; x++) {
                int64_t pixel = (int64_t)y * job->film->width + x;
                if (job->film->samples[pixel] <= 0.0f) {
                    film_set(job->film, pixel, &nothing);
                }
            }
        }
    }
}

bool tiles_render(const Tracer *tracer, Film *film, const Run *run, RenderPass *pass, double every,
                  void *user, RenderStats *stats, Error *e)
{
    Job job = {.tracer = tracer,
               .film = film,
               .run = run,
               .first = tracer->world->render.first_sample,
               .end = render_end(&tracer->world->render),
               .start = run_seconds(),
               .caller = pthread_self()};
    job.tile = make_tiles(&tracer->world->film, &job.tile_count, &job.pixels, e);
    if (!job.tile) {
        return false;
    }
    count_samples(&job);
    const Calls calls = {pass, pass ? every : 0.0, user};
    render_passes(&job, &calls);
    *stats = (RenderStats){.paths = job.paths,
                           .rays = job.rays,
                           .seconds = run_seconds() - job.start,
                           .samples = least_samples(&job)};
    bool done = true;
    if (run_is_cancelled(run)) {
        clear_unseen(&job);
        // not a single path was traced, now or before
        done = job.paths > 0 || least_samples(&job) > 0 || run_cancel_error(e);
    }
    free(job.tile);
    return done;
}

// Traces one path for each block of LOOK_STEP x LOOK_STEP pixels and gives its result to all of
// them.
static void look_at_tile(const Job *job, const Tile *tile)
{
    for (int y = tile->y0; y < tile->y1; y += LOOK_STEP) {
        for (int x = tile->x0; x < tile->x1 && !run_is_cancelled(job->run); x += LOOK_STEP) {
            PathResult path;
            PathSum one = {.samples = 0};
            PixelSum sum = {.samples = 0};
            integrator_paths(job->tracer, x, y, 0, 1, &path);
            path_sum_add(&one, &path, 1);
            pixel_sum_add(&sum, &one);
            for (int j = y; j < y + LOOK_STEP && j < tile->y1; j++) {
                for (int i = x; i < x + LOOK_STEP && i < tile->x1; i++) {
                    film_set(job->film, (int64_t)j * job->film->width + i, &sum);
                }
            }
        }
    }
}

bool tiles_look(const Tracer *tracer, Film *film, const Run *run, Error *e)
{
    Job job = {.tracer = tracer, .film = film, .run = run};
    job.tile = make_tiles(&tracer->world->film, &job.tile_count, &job.pixels, e);
    if (!job.tile) {
        return false;
    }
    _Atomic int next = 0;
#pragma omp parallel num_threads(run->threads)
    {
        unsigned state = accel_thread_begin();
        for (int i = next++; i < job.tile_count; i = next++) {
            look_at_tile(&job, &job.tile[i]);
        }
        accel_thread_end(state);
    }
    free(job.tile);
    film_forget(film, tracer->world->film.crop);
    return !run_is_cancelled(run) || run_cancel_error(e);
}
