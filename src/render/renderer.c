#include "render/renderer.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/integrator.h"
#include "render/sky/dome.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { TILE_SIZE = 16, PASS_LIMIT = 64, LEAST_ADAPTIVE_SAMPLES = 16 };

struct Renderer {
    const World *world;
    MaterialSet *materials;
    Accel *accel;
    Lights *lights;
    const char *isa;
};

static bool build_lights(Renderer *renderer, const Run *run, Error *e)
{
    Aabb box = accel_bounds(renderer->accel);
    float radius = aabb_is_empty(box) ? 1.0f : 0.5f * vec3_distance(box.low, box.high);
    lights_free(renderer->lights);
    renderer->lights = lights_new(renderer->world, radius, run, e);
    return renderer->lights;
}

static bool build_accel(Renderer *renderer, const Run *run, Error *e)
{
    accel_free(renderer->accel); // first: two may not fit
    renderer->accel = accel_new(renderer->world, renderer->materials, renderer->isa, run, e);
    return renderer->accel;
}

// A scene's world has every built-in material, and most of them are on nothing.
static MaterialSet *prepare_materials(const World *world, Error *e)
{
    bool *used = memory_alloc_zero(world->material_count, sizeof *used, e);
    if (!used) {
        return NULL;
    }
    for (int64_t i = 0; i < world->geometry.count; i++) {
        used[world->geometry.part[i].material] = true;
    }
    MaterialSet *set = material_set_new(world->material, used, world->material_count, e);
    free(used);
    return set;
}

Renderer *renderer_new(const World *world, const char *isa, const Run *run, Error *e)
{
    Renderer *renderer = memory_alloc_zero(1, sizeof *renderer, e);
    if (!renderer) {
        return NULL;
    }
    renderer->world = world;
    renderer->isa = isa;
    renderer->materials = prepare_materials(world, e);
    if (!renderer->materials || !build_accel(renderer, run, e) || !build_lights(renderer, run, e)) {
        renderer_free(renderer);
        return NULL;
    }
    return renderer;
}

bool renderer_update(Renderer *renderer, unsigned changed, const Run *run, Error *e)
{
    const World *world = renderer->world;
    if (changed & RENDERER_MATERIALS) {
        MaterialSet *fresh = prepare_materials(world, e);
        if (!fresh) {
            return false;
        }
        accel_use_materials(renderer->accel, fresh);
        material_set_free(renderer->materials);
        renderer->materials = fresh;
    }
    bool filters = changed & RENDERER_MATERIALS && !accel_fits_materials(renderer->accel);
    if ((changed & RENDERER_LAMPS || filters) && !build_accel(renderer, run, e)) {
        return false;
    }
    if (changed == RENDERER_SKY_TURNED && !lights_water(renderer->lights)) {
        lights_turn_sky(renderer->lights);
        return true;
    }
    return changed == 0 || build_lights(renderer, run, e);
}

void renderer_free(Renderer *renderer)
{
    if (renderer) {
        lights_free(renderer->lights);
        accel_free(renderer->accel);
        material_set_free(renderer->materials);
        free(renderer);
    }
}

// ---- one pixel: samples are summed in double and merged into the film's means

typedef struct PixelSum {
    double color[3], alpha, albedo[3], normal[3], position[3], depth, luminance, luminance_squared;
    int hits, object; // object + 1 of the first hit
    int64_t rays;
} PixelSum;

static void sum_vector(double sum[3], Vec3 v)
{
    sum[0] += (double)v.x;
    sum[1] += (double)v.y;
    sum[2] += (double)v.z;
}

static void pixel_add(PixelSum *sum, const PathResult *path)
{
    double l = (double)luminance(path->color);
    sum_vector(sum->color, path->color);
    sum->alpha += (double)path->alpha;
    sum->luminance += l;
    sum->luminance_squared += l * l;
    sum->rays += path->rays;
    sum_vector(sum->albedo, path->albedo);
    if (path->hit) {
        sum_vector(sum->normal, path->normal);
        sum_vector(sum->position, path->position);
        sum->depth += (double)path->depth;
        sum->object = sum->hits++ ? sum->object : path->object + 1;
    }
}

// The mean of `old` (of weight n) and a sum over m more.
static float merged(float old, double n, double sum, double m)
{
    return (float)(((n > 0.0 ? (double)old * n : 0.0) + sum) / (n + m));
}

static Vec3 merged_vector(Vec3 old, double n, const double sum[3], double m)
{
    return vec3(merged(old.x, n, sum[0], m), merged(old.y, n, sum[1], m),
                merged(old.z, n, sum[2], m));
}

// Variance of the mean from the sums of squared deviations of both parts (Chan et al. 1979).
static float merged_variance(const Film *film, int64_t i, double n, const PixelSum *s, double m)
{
    double old_mean = n > 0.0 ? (double)luminance(film->color[i]) : 0.0, mean = s->luminance / m;
    double deviations = n > 1.0 ? (double)film->variance[i] * n * (n - 1.0) : 0.0;
    deviations += fmax(0.0, s->luminance_squared - mean * s->luminance);
    deviations += (mean - old_mean) * (mean - old_mean) * n * m / (n + m);
    double all = n + m;
    return all > 1.0 ? (float)(deviations / (all * (all - 1.0))) : 0.0f;
}

static void film_merge(Film *film, int64_t i, int samples_before, int samples_added,
                       const PixelSum *s)
{
    double n = samples_before, m = samples_added, hits = s->hits;
    double hits_before = samples_before > 0 ? (double)film->hits[i] : 0.0;
    film->variance[i] = merged_variance(film, i, n, s, m);
    film->color[i] = merged_vector(film->color[i], n, s->color, m);
    film->alpha[i] = merged(film->alpha[i], n, s->alpha, m);
    film->albedo[i] = merged_vector(film->albedo[i], n, s->albedo, m);
    film->normal[i] = merged_vector(film->normal[i], n, s->normal, m);
    if (hits_before + hits > 0.0) {
        film->depth[i] = merged(film->depth[i], hits_before, s->depth, hits);
        film->position[i] = merged_vector(film->position[i], hits_before, s->position, hits);
    } else {
        film->depth[i] = INFINITY;
        film->position[i] = vec3_splat(0.0f);
    }
    if (hits_before <= 0.0) {
        film->object[i] = (float)s->object;
    }
    film->hits[i] = (float)(hits_before + hits);
    film->samples[i] = (float)(n + m);
}

// ---- tiles and passes

typedef struct Tile {
    int x0, y0, x1, y1;
    int samples; // taken so far
    bool quiet;  // below the asked noise
} Tile;

typedef struct Job {
    Renderer *renderer;
    const Tracer *tracer;
    Film *film;
    const Run *run;
    Tile *tile;
    int tile_count;
    int64_t pixels;
    double start;
    pthread_t caller; // the thread that hears of progress
    _Atomic int64_t rays, paths;
    _Atomic int64_t settled; // paths traced or saved by adaptive stopping
} Job;

// Brings the tile's pixels to `end` samples and counts rays and paths. Interrupted, the pixels left
// over keep what they had, and the tile counts as it was: no pass comes after.
static void render_tile(Job *job, Tile *tile, int end)
{
    int64_t rays = 0, pixels = 0;
    for (int y = tile->y0; y < tile->y1; y++) {
        for (int x = tile->x0; x < tile->x1 && !run_is_cancelled(job->run); x++) {
            PixelSum sum = {.object = 0};
            for (int k = tile->samples, count; k < end; k += count) {
                PathResult path[PACKET_SIZE];
                count = end - k < PACKET_SIZE ? end - k : PACKET_SIZE;
                integrator_paths(job->tracer, x, y, k, count, path);
                for (int i = 0; i < count; i++) {
                    pixel_add(&sum, &path[i]);
                }
            }
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

// Mean over the tile of a pixel's standard error relative to its luminance, with a floor that keeps
// black from asking for ever.
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
    double limit = job->renderer->world->render.max_seconds;
    return run_is_cancelled(job->run) || (limit > 0.0 && run_seconds() - job->start > limit);
}

static void tell_progress(const Job *job)
{
    const RenderParams *params = &job->renderer->world->render;
    double done = (double)job->settled / ((double)job->pixels * params->samples);
    if (params->max_seconds > 0.0) {
        done = fmax(done, (run_seconds() - job->start) / params->max_seconds);
    }
    run_progress(job->run, "trace", fmin(done, 1.0));
}

// Brings every tile from `before` to `end` samples. Out of time, it finishes the tiles that were
// begun, and the whole first pass, so that there is a whole picture; interrupted, it ends at once.
static void render_pass(Job *job, int before, int end)
{
    const RenderParams *params = &job->renderer->world->render;
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
    int x0 = (int)lroundf(clampf(film->crop[0], 0.0f, 1.0f) * (float)film->width);
    int y0 = (int)lroundf(clampf(film->crop[1], 0.0f, 1.0f) * (float)film->height);
    int x1 = (int)lroundf(clampf(film->crop[2], 0.0f, 1.0f) * (float)film->width);
    int y1 = (int)lroundf(clampf(film->crop[3], 0.0f, 1.0f) * (float)film->height);
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

static void render_passes(Job *job, RenderPass *pass, void *user)
{
    int samples = job->renderer->world->render.samples, done = 0;
    while (done < samples && !(done > 0 && must_stop(job)) && !all_quiet(job)) {
        int before = done, more = done < 1 ? 1 : (done < PASS_LIMIT ? done : PASS_LIMIT);
        done = done + more < samples ? done + more : samples;
        render_pass(job, before, done);
        bool doubled = (done & (done - 1)) == 0;
        if (pass && (doubled || done == samples) && !run_is_cancelled(job->run)) {
            pass(user, job->film, done);
        }
    }
}

// Nothing is known of the pixels that this rendering is to make.
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

// What an interrupted first pass did not reach is black and transparent, not an earlier picture.
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

static bool check_job(const World *world, const Film *film, Error *e)
{
    if (film->width != world->film.width || film->height != world->film.height) {
        return error_set(e, ERROR_INTERNAL, "a film of %d x %d pixels for a picture of %d x %d",
                         film->width, film->height, world->film.width, world->film.height);
    }
    if (world->render.samples < 1) {
        return error_set(e, ERROR_INPUT, "%d samples a pixel; at least 1 is needed",
                         world->render.samples);
    }
    return true;
}

bool renderer_render(Renderer *renderer, Film *film, const Run *run, RenderPass *pass, void *user,
                     RenderStats *stats, Error *e)
{
    const World *world = renderer->world;
    if (!check_job(world, film, e)) {
        return false;
    }
    Tracer *tracer = memory_alloc_zero(1, sizeof *tracer, e);
    Job job = {.renderer = renderer,
               .tracer = tracer,
               .film = film,
               .run = run,
               .start = run_seconds(),
               .caller = pthread_self()};
    job.tile = tracer ? make_tiles(&world->film, &job.tile_count, &job.pixels, e) : NULL;
    if (job.tile) {
        tracer->world = world;
        tracer->accel = renderer->accel;
        tracer->lights = renderer->lights;
        tracer->materials = renderer->materials;
        tracer->camera = camera_frame(&world->camera, film->width, film->height);
        const RenderParams *params = &world->render;
        tracer->seed =
            params->noise_seed ? random_key(params->seed, params->noise_seed) : params->seed;
        filter_fill(&tracer->filter, world->film.filter, world->film.filter_radius);
        sobol_table_fill(&tracer->sobol);
        tracer_set_media(tracer, accel_bounds(renderer->accel));
        mark_unseen(&job);
        render_passes(&job, pass, user);
        *stats = (RenderStats){.paths = job.paths,
                               .rays = job.rays,
                               .seconds = run_seconds() - job.start,
                               .memory = accel_bytes(renderer->accel),
                               .samples = least_samples(&job)};
    }
    bool done = job.tile != NULL;
    if (done && run_is_cancelled(run)) {
        clear_unseen(&job);
        done = job.paths > 0 || run_cancel_error(e); // before there was anything to show
    }
    free(job.tile);
    free(tracer);
    return done;
}
