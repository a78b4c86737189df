#include "render/tiles.h"

#include "base/color.h"
#include "base/memory.h"
#include "render/film_merge.h"
#include "render/world.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { TILE_SIZE = 16, PASS_LIMIT = 64, LEAST_ADAPTIVE_SAMPLES = 16, LOOK_STEP = 4 };

typedef struct Tile {
    int x0, y0, x1, y1;
    int samples; // taken so far
    bool quiet;  // its noise is below max_noise
} Tile;

typedef struct Job {
    const Tracer *tracer;
    Film *film;
    const Run *run;
    Tile *tile;
    int tile_count;
    int64_t pixels;
    double start;
    pthread_t caller; // the thread that reports progress
    _Atomic int64_t rays, paths;
    _Atomic int64_t settled; // paths traced, or skipped by adaptive stopping
} Job;

// Adds samples begin .. end - 1 of the pixel to its sum. Which rays share a packet may decide what
// a ray meets that grazes an edge, so a wave holds samples of one pixel whose numbers alone tell
// that they belong together.
static void trace_pixel(const Tracer *tracer, int x, int y, int begin, int end, PixelSum *sum)
{
    PathResult result[WAVE_SIZE];
    for (int k = begin, count; k < end; k += count) {
        count = WAVE_SIZE - k % WAVE_SIZE;
        count = count < end - k ? count : end - k;
        integrator_paths(tracer, x, y, k, count, result);
        for (int i = 0; i < count; i++) {
            pixel_sum_add(sum, &result[i]);
        }
    }
}

// Renders the tile up to `end` samples per pixel. When cancelled, the remaining pixels and the
// tile's count stay as they were; no further pass follows.
static void render_tile(Job *job, Tile *tile, int end)
{
    int64_t rays = 0, pixels = 0;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1 && !run_is_cancelled(job->run); x++) {
            PixelSum sum = {.object = 0};
            trace_pixel(job->tracer, x, y, tile->samples, end, &sum);
            film_merge(job->film, (int64_t)y * job->film->width + x, tile->samples,
                       end - tile->samples, &sum);
            rays += sum.rays;
            pixels++;
        }
    }
    job->rays += rays;
    job->paths += pixels * (end - tile->samples);
    if (pixels == (int64_t)(tile->x1 - tile->x0) * (tile->y1 - tile->y0)) {
        tile->samples = end;
    }
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
    double done = (double)job->settled / ((double)job->pixels * params->samples);
    if (params->max_seconds > 0.0) {
        done = fmax(done, (run_seconds() - job->start) / params->max_seconds);
    }
    run_progress(job->run, "trace", fmin(done, 1.0));
}

// Renders every tile from `before` to `end` samples. When time is over it finishes the tiles in
// work, and all of the first pass, so that the picture is complete; when cancelled it stops at
// once.
static void render_pass(Job *job, int before, int end)
{
    const RenderParams *params = &job->tracer->world->render;
    _Atomic int next = 0;
    _Atomic bool stop = false;
#pragma omp parallel num_threads(job->run->threads)
    {
        unsigned state = accel_thread_begin();
        for (int i = next++; i < job->tile_count && !stop; i = next++) {
            Tile *tile = &job->tile[i];
            int64_t area = (int64_t)(tile->x1 - tile->x0) * (tile->y1 - tile->y0);
            job->settled += area * (end - before);
            if (!tile->quiet) {
                render_tile(job, tile, end);
                tile->quiet = params->max_noise > 0.0f && end >= LEAST_ADAPTIVE_SAMPLES &&
                              tile_noise(job->film, tile) < params->max_noise;
            }
            stop = stop || run_is_cancelled(job->run) || (end > 1 && must_stop(job));
            if (pthread_equal(pthread_self(), job->caller)) {
                tell_progress(job);
            }
        }
        accel_thread_end(state);
    }
}

static Tile *make_tiles(const FilmParams *film, int *count, int64_t *pixels, Error *e)
{
    PixelBox crop = film_crop_pixels(film->width, film->height, film->crop);
    int x0 = crop.x0, y0 = crop.y0, x1 = crop.x1, y1 = crop.y1;
    if (x0 >= x1 || y0 >= y1) {
        error_set(e, ERROR_INPUT, "the crop leaves no pixel; x0 < x1 and y0 < y1 are needed");
        return NULL;
    }
    int columns = (x1 - x0 + TILE_SIZE - 1) / TILE_SIZE,
        rows = (y1 - y0 + TILE_SIZE - 1) / TILE_SIZE;
    *pixels = (int64_t)(x1 - x0) * (y1 - y0);
    *count = columns * rows;
    Tile *tile = memory_alloc_zero(*count, sizeof *tile, e);
    for (int i = 0; tile && i < *count; i++) {
        int x = x0 + i % columns * TILE_SIZE, y = y0 + i / columns * TILE_SIZE;
        tile[i] = (Tile){.x0 = x,
                         .y0 = y,
                         .x1 = x + TILE_SIZE < x1 ? x + TILE_SIZE : x1,
                         .y1 = y + TILE_SIZE < y1 ? y + TILE_SIZE : y1};
    }
    return tile;
}

static int least_samples(const Job *job)
{
    int least = job->tile[0].samples;
    for (int i = 1; i < job->tile_count; i++) {
        least = job->tile[i].samples < least ? job->tile[i].samples : least;
    }
    return least;
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

// Passes end at 1, 4, 16, 32, 64, 128 ... samples, so that few of them go in waves that are not
// full.
static int pass_end(int done, int samples)
{
    int more = done < WAVE_SIZE ? 3 * done : done;
    more = done < 1 ? 1 : (more < PASS_LIMIT ? more : PASS_LIMIT);
    return done + more < samples ? done + more : samples;
}

static void render_passes(Job *job, RenderPass *pass, void *user)
{
    int samples = job->tracer->world->render.samples, done = 0;
    while (done < samples && !(done > 0 && must_stop(job)) && !all_quiet(job)) {
        int before = done;
        done = pass_end(done, samples);
        render_pass(job, before, done);
        bool power_of_two = (done & (done - 1)) == 0;
        if (pass && (power_of_two || done == samples) && !run_is_cancelled(job->run)) {
            pass(user, job->film, done);
        }
    }
}

// Forgets the samples of an earlier picture in the pixels of this one.
static void mark_unseen(const Job *job)
{
    for (int i = 0; i < job->tile_count; i++) {
        const Tile *tile = &job->tile[i];
        for (int y = tile->y0; y < tile->y1; y++) {
            for (int x = tile->x0; x < tile->x1; x++) {
                job->film->samples[(int64_t)y * job->film->width + x] = 0.0f;
            }
        }
    }
}

// Clears the pixels that a cancelled first pass did not reach: black and transparent.
static void clear_unseen(const Job *job)
{
    const PixelSum nothing = {.object = 0};
    for (int i = 0; i < job->tile_count; i++) {
        const Tile *tile = &job->tile[i];
        for (int y = tile->y0; y < tile->y1 && tile->samples == 0; y++) {
            for (int x = tile->x0; x < tile->x1; x++) {
                int64_t pixel = (int64_t)y * job->film->width + x;
                if (job->film->samples[pixel] <= 0.0f) {
                    film_merge(job->film, pixel, 0, 1, &nothing);
                    job->film->samples[pixel] = 0.0f;
                }
            }
        }
    }
}

bool tiles_render(const Tracer *tracer, Film *film, const Run *run, RenderPass *pass, void *user,
                  RenderStats *stats, Error *e)
{
    Job job = {.tracer = tracer,
               .film = film,
               .run = run,
               .start = run_seconds(),
               .caller = pthread_self()};
    job.tile = make_tiles(&tracer->world->film, &job.tile_count, &job.pixels, e);
    if (!job.tile) {
        return false;
    }
    mark_unseen(&job);
    render_passes(&job, pass, user);
    *stats = (RenderStats){.paths = job.paths,
                           .rays = job.rays,
                           .seconds = run_seconds() - job.start,
                           .samples = least_samples(&job)};
    bool done = true;
    if (run_is_cancelled(run)) {
        clear_unseen(&job);
        done = job.paths > 0 || run_cancel_error(e); // not a single path was traced
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
            PixelSum sum = {.object = 0};
            integrator_paths(job->tracer, x, y, 0, 1, &path);
            pixel_sum_add(&sum, &path);
            for (int j = y; j < y + LOOK_STEP && j < tile->y1; j++) {
                for (int i = x; i < x + LOOK_STEP && i < tile->x1; i++) {
                    film_merge(job->film, (int64_t)j * job->film->width + i, 0, 1, &sum);
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
    return !run_is_cancelled(run) || run_cancel_error(e);
}
