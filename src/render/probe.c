#include "render/probe.h"

#include "render/film.h"

#include <math.h>
#include <stdatomic.h>
#include <time.h>

// Blocks rather than pixels, because neighbours find in the caches what they share.
enum { BLOCK = 4, BLOCKS_AN_AXIS = 24, PASSES = 4 };

static const int pass_end[PASSES] = {1, 4, 16, 32};

static double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// Traces a pass over number `index` of the blocks; returns its number of paths.
static int trace_block(const Tracer *tracer, PixelBox crop, int index, int begin, int end)
{
    PathResult result[WAVE_SIZE];
    int column = index % BLOCKS_AN_AXIS, row = index / BLOCKS_AN_AXIS, paths = 0;
    int left = crop.x0 + (2 * column + 1) * (crop.x1 - crop.x0) / (2 * BLOCKS_AN_AXIS);
    int top = crop.y0 + (2 * row + 1) * (crop.y1 - crop.y0) / (2 * BLOCKS_AN_AXIS);
    for (int y = top; y < top + BLOCK && y < crop.y1; y++) {
        for (int x = left; x < left + BLOCK && x < crop.x1; x++) {
            integrator_paths(tracer, x, y, begin, end - begin, result);
            paths += end - begin;
        }
    }
    return paths;
}

// Processor seconds a path of one pass.
static double probe_pass(const Tracer *tracer, PixelBox crop, int begin, int end, const Run *run)
{
    _Atomic int next = 0;
    double seconds = 0.0;
    int64_t paths = 0;
#pragma omp parallel num_threads(run->threads) reduction(+ : seconds, paths)
    {
        unsigned state = accel_thread_begin();
        double start = thread_seconds();
        for (int i = next++; i < BLOCKS_AN_AXIS * BLOCKS_AN_AXIS && !run_is_cancelled(run);
             i = next++) {
            paths += trace_block(tracer, crop, i, begin, end);
        }
        seconds += thread_seconds() - start;
        accel_thread_end(state);
    }
    return paths > 0 ? seconds / (double)paths : 0.0;
}

bool probe_paths(const Tracer *tracer, const Run *run, PathCosts *costs, Error *e)
{
    const FilmParams *film = &tracer->world->film;
    PixelBox crop = film_crop_pixels(film->width, film->height, film->crop);
    int samples = tracer->world->render.samples;
    double cost[PASSES] = {0.0};
    run_progress(run, "probe", 0.0);
    for (int i = 0, begin = 0; i < PASSES && begin < samples; begin = pass_end[i++]) {
        int end = samples < pass_end[i] ? samples : pass_end[i];
        cost[i] = probe_pass(tracer, crop, begin, end, run);
        run_progress(run, "probe", (double)(i + 1) / PASSES);
    }
    *costs = (PathCosts){.early = {cost[0], cost[1], cost[2]}, .later = cost[3]};
    return !run_is_cancelled(run) || run_cancel_error(e);
}

double probe_pass_seconds(const PathCosts *costs, int begin, int end)
{
    int pass = 0;
    while (pass < PASSES - 1 && begin >= pass_end[pass]) {
        pass++;
    }
    return (end - begin) * (pass < PASSES - 1 ? costs->early[pass] : costs->later);
}
