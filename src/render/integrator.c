#include "render/integrator.h"

#include "base/random.h"
#include "render/first_seen.h"
#include "render/path.h"
#include "render/world.h"

#include <stddef.h>

// Paths that advance together, one ray at a time. Each stage runs over all of them before the next
// begins: rays are traced in packets, and the processor overlaps the waits of independent paths for
// memory and for results.
typedef struct Wave {
    const Tracer *tracer;
    int count; // paths on their way
    Path *path[WAVE_SIZE];
    Vertex vertex[WAVE_SIZE];
    ShadowQueue shadows;
    CloudGuide guide;
    SamplerLanes lanes;
} Wave;

_Static_assert((int)WAVE_SIZE <= (int)SAMPLER_LANES && (int)WAVE_SIZE <= (int)BACKGROUND_LIMIT,
               "a wave fits");

void path_add_light(Path *path, Vec3 radiance)
{
    Vec3 light = vec3_mul(path->throughput, radiance);
    // as of the light that clouds sample, and that no shadow ray finds
    bool direct = path->depth < 2 && !path->in_cloud && !path->strayed;
    Vec3 *sum = direct ? &path->direct : &path->indirect;
    *sum = vec3_add(*sum, light);
}

// Paths that carry less than half of what the camera sent survive in proportion to it. Measured:
// less noise for the time than the throughput itself or its square root.
bool path_survives(Path *path)
{
    if (path->depth < path->tracer->world->render.roulette_depth) {
        return true;
    }
    Vec3 t = path->throughput;
    float chance = 2.0f * larger(t.x, larger(t.y, t.z));
    if (chance >= 1.0f) {
        return true;
    }
    if (path->roulette >= chance) {
        return false;
    }
    path->throughput = vec3_scale(t, 1.0f / chance);
    return true;
}

void path_cast_shadow(Path *path, const Ray *ray, Vec3 light)
{
    path->rays++;
    ShadowQueue *queue = path->shadows;
    Vec3 *sum = path->depth < 1 ? &path->direct : &path->indirect; // one bounce further
    queue->ray[queue->count] = *ray;
    queue->light[queue->count] = (ShadowLight){vec3_mul(path->throughput, light), sum};
    queue->count++;
}

static void trace_shadows(const Accel *accel, ShadowQueue *queue)
{
    bool blocked[SHADOWS_LIMIT];
    accel_occluded_many(accel, queue->ray, queue->count, blocked);
    for (int i = 0; i < queue->count; i++) {
        ShadowLight *shadow = &queue->light[i];
        *shadow->sum = blocked[i] ? *shadow->sum : vec3_add(*shadow->sum, shadow->light);
    }
    queue->count = 0;
}

// Draws set `set` of their bounce for the paths of the vertices.
static void draw_for(SamplerLanes *lanes, Vertex *const vertex[], int count, uint32_t set)
{
    sampler_lanes_clear(lanes);
    for (int i = 0; i < count; i++) {
        const Path *path = vertex[i]->path;
        sampler_lanes_put(lanes, i, &path->sampler, set + SETS_PER_BOUNCE * (uint32_t)path->depth);
    }
    if (count > 0) {
        sampler_lanes_draw(vertex[0]->path->sampler.table, lanes);
    }
}

// Fills path, result and the wave.
static void start_paths(const Tracer *tracer, int x, int y, int sample, int count, Path path[],
                        PathResult result[], Wave *wave)
{
    wave->tracer = tracer;
    wave->count = count;
    wave->shadows.count = 0;
    wave->guide.known = false;
    camera_ray(&tracer->camera, (float)x + 0.5f, (float)y + 0.5f, (float[]){0.5f, 0.5f},
               &wave->guide.origin, &wave->guide.direction);
    sampler_lanes_clear(&wave->lanes);
    Sampler sampler[WAVE_SIZE];
    samplers_at(&tracer->plan, (uint32_t)x, (uint32_t)y, (uint32_t)sample, count, sampler);
    for (int i = 0; i < count; i++) {
        path[i] = (Path){.tracer = tracer,
                         .result = &result[i],
                         .shadows = &wave->shadows,
                         .guide = &wave->guide,
                         .sampler = sampler[i],
                         .throughput = {1.0f, 1.0f, 1.0f},
                         .media.now = tracer->outside,
                         .spread = tracer->camera.pixel_angle,
                         .mirrored = true,
                         .sharp = true,
                         .guided = true,
                         .straight = true,
                         .clear = 1.0f,
                         .near = NEAR_BY_POWER,
                         .ray.far = INFINITY};
        result[i] = (PathResult){.albedo = vec3_splat(1.0f), .alpha = 1.0f, .depth = INFINITY};
        sampler_lanes_put(&wave->lanes, i, &sampler[i], SET_CAMERA);
        wave->path[i] = &path[i];
    }
    sampler_lanes_draw(&tracer->plan.table, &wave->lanes);
    for (int i = 0; i < count; i++) {
        Path *p = &path[i];
        float u[4];
        sampler_lanes_get(&wave->lanes, i, u);
        float film_x = (float)x + 0.5f + filter_sample(&tracer->filter, u[0]);
        float film_y = (float)y + 0.5f + filter_sample(&tracer->filter, u[1]);
        camera_ray(&tracer->camera, film_x, film_y, u + 2, &p->ray.origin, &p->ray.direction);
        p->key = (uint32_t)random_key(p->sampler.key, p->sampler.reversed);
        p->ray.key = p->key++;
        p->start = p->from.position = p->ray.origin;
        p->cloud_key = random_key(p->key, 0xc10d);
    }
}

// The light of the sky for the paths that left the scene.
static void add_backgrounds(const Tracer *tracer, Path *const path[], int count)
{
    const Sky *sky = &tracer->world->sky;
    BackgroundRay ray[WAVE_SIZE];
    Vec3 radiance[WAVE_SIZE];
    for (int i = 0; i < count; i++) {
        const Path *p = path[i];
        float pdf = p->bsdf_pdf / lights_mix(tracer->lights, p->near, false);
        ray[i] = (BackgroundRay){p->from.position, p->ray.direction, pdf, p->spread};
    }
    lights_background_many(tracer->lights, ray, count, radiance);
    for (int i = 0; i < count; i++) {
        if (path[i]->depth == 0 && !(sky->visible && sky->kind != SKY_NONE)) {
            path[i]->result->alpha = 0.0f;
        } else {
            path_add_light(path[i], radiance[i]);
        }
    }
}

// Total reflection at the water's surface, seen from below. False where the ray leaves the water,
// or starts outside of it.
static bool reflect_off_water(Path *path)
{
    const Tracer *tracer = path->tracer;
    const Water *water = lights_water(tracer->lights);
    float rise = path->ray.direction.y, level = tracer->world->medium.height;
    if (!water_covers(water, path->ray.origin) || !(rise > 0.0f) ||
        path->depth >= tracer->world->render.max_depth) {
        return false;
    }
    float t = (level - path->ray.origin.y) / rise;
    Vec3 point = vec3_madd(path->ray.origin, t, path->ray.direction);
    bool waves = path->bsdf_pdf <= 0.0f;
    Vec3 normal = waves ? water_normal(water, point) : vec3(0.0f, 1.0f, 0.0f);
    WaterPassage passage;
    if (water_leave(path->ray.direction, normal, &passage)) {
        return false;
    }
    Vec3 d = vec3_madd(path->ray.direction, -2.0f * vec3_dot(path->ray.direction, normal), normal);
    d.y = -fmaxf(fabsf(d.y), 1e-3f); // a steep wave must not send it out of the water
    point.y = level - 1e-5f * fmaxf(fabsf(level), t);
    path->ray =
        (Ray){.origin = point, .direction = vec3_normalize(d), .far = INFINITY, .key = path->key++};
    path->from.position = path->start = point;
    path->travelled = path->bsdf_pdf = 0.0f;
    path->straight = false;
    path->depth++;
    return true;
}

// Where a ray has led its path.
typedef enum Whereabouts { IN_MEDIUM, AT_SURFACE, OUTSIDE, NOWHERE } Whereabouts;

static Whereabouts travel(Path *path, const Hit *hit, bool met)
{
    if (met && path->straight && (path->media.now.scatters || path->tracer->clouds)) {
        path_note_behind(path, hit);
    }
    if (met) {
        path_show_light(path, hit);
    }
    float far = met ? hit->t : INFINITY, cloud = path_meet_cloud(path, far);
    if (path->media.now.present) {
        Travel travel = path_travel(path, fminf(far, cloud));
        if (travel != TRAVEL_ARRIVED) {
            return travel == TRAVEL_SCATTERED ? IN_MEDIUM : NOWHERE;
        }
    }
    if (cloud < INFINITY) {
        return path_scatter_in_cloud(path, cloud) == TRAVEL_SCATTERED ? IN_MEDIUM : NOWHERE;
    }
    if (met) {
        return AT_SURFACE;
    }
    bool water = path->tracer->world->medium.kind == MEDIUM_WATER;
    return water && reflect_off_water(path) ? IN_MEDIUM : OUTSIDE;
}

// Traces the rays. The paths that met surfaces become vertices, whose number is returned; those
// that go on within a medium stay in the wave. camera: these are camera rays.
static int trace_rays(Wave *wave, bool camera)
{
    Ray ray[WAVE_SIZE];
    Hit hit[WAVE_SIZE];
    bool met[WAVE_SIZE];
    Path *outside[WAVE_SIZE];
    for (int i = 0; i < wave->count; i++) {
        ray[i] = wave->path[i]->ray;
        wave->path[i]->rays++;
    }
    accel_intersect_many(wave->tracer->accel, ray, wave->count, hit, met);
    for (int i = 0; i < wave->count && camera; i++) {
        first_seen(wave->tracer, &ray[i], met[i], &hit[i], wave->path[i]->result);
    }
    int going = 0, vertices = 0, escaped = 0;
    for (int i = 0; i < wave->count; i++) {
        Path *path = wave->path[i];
        switch (travel(path, &hit[i], met[i])) {
        case IN_MEDIUM:
            wave->path[going++] = path;
            break;
        case AT_SURFACE:
            wave->vertex[vertices].path = path;
            wave->vertex[vertices++].hit = hit[i];
            break;
        case OUTSIDE:
            path_see_through_rain(path, INFINITY);
            outside[escaped++] = path;
            break;
        case NOWHERE:
            break;
        }
    }
    wave->count = going;
    add_backgrounds(wave->tracer, outside, escaped);
    return vertices;
}

// The stages at surfaces. Paths that go on join the wave.
static void scatter_at_surfaces(Wave *wave, int vertices)
{
    Vertex *vertex[WAVE_SIZE] = {NULL};
    int scattering = 0;
    for (int i = 0; i < vertices; i++) {
        Vertex *v = &wave->vertex[i];
        Arrival arrival = path_arrive(v);
        if (arrival == ARRIVAL_CROSSED) {
            wave->path[wave->count++] = v->path;
        } else if (arrival == ARRIVAL_SCATTERS) {
            vertex[scattering++] = v;
        }
    }
    float u[4];
    if (lights_can_sample(wave->tracer->lights)) {
        draw_for(&wave->lanes, vertex, scattering, SET_LIGHT);
        for (int i = 0; i < scattering; i++) {
            sampler_lanes_get(&wave->lanes, i, u);
            path_sample_light(vertex[i], u);
        }
    }
    draw_for(&wave->lanes, vertex, scattering, SET_BSDF);
    for (int i = 0; i < scattering; i++) {
        sampler_lanes_get(&wave->lanes, i, u);
        if (path_bounce(vertex[i], u)) {
            wave->path[wave->count++] = vertex[i]->path;
        }
    }
}

// Bounds the luminance of indirect light: what exceeds the limit is hardly ever light, but noise.
static Vec3 clamped(Vec3 light, float limit)
{
    float l = luminance(light);
    return limit > 0.0f && l > limit ? vec3_scale(light, limit / l) : light;
}

static void finish(const Path *path, PathResult *result)
{
    Vec3 color = vec3_add(path->direct, clamped(path->indirect, path->tracer->world->render.clamp));
    result->color = vec3_finite(color) ? color : vec3_splat(0.0f);
    result->rays = path->rays;
}

void integrator_paths(const Tracer *tracer, int x, int y, int sample, int count,
                      PathResult result[])
{
    Path path[WAVE_SIZE];
    Wave wave; // not cleared, because that takes as long as a stage
    start_paths(tracer, x, y, sample, count, path, result, &wave);
    for (bool camera = true; wave.count > 0; camera = false) {
        int vertices = trace_rays(&wave, camera);
        scatter_at_surfaces(&wave, vertices);
        trace_shadows(tracer->accel, &wave.shadows);
    }
    for (int i = 0; i < count; i++) {
        finish(&path[i], &result[i]);
    }
}

void integrator_wave(const Tracer *tracer, int sample, int *begin, int *end)
{
    *begin = sample < 1 ? 0 : (sample < 4 ? 1 : (sample < 16 ? 4 : sample - sample % WAVE_SIZE));
    *end = sample < 1 ? 1 : (sample < 4 ? 4 : *begin - *begin % WAVE_SIZE + WAVE_SIZE);
    *begin = sample >= tracer->planned && *begin < tracer->planned ? tracer->planned : *begin;
    *end = sample<tracer->planned && * end> tracer->planned ? tracer->planned : *end;
}

int integrator_pass_end(int done, int end)
{
    enum { PASS_LIMIT = 64 };
    int next = done < 1 ? 1 : (done < 4 ? 4 : (done < 16 ? 16 : (done < 32 ? 32 : 0)));
    next = next > 0 ? next : done - done % PASS_LIMIT + PASS_LIMIT;
    return next < end ? next : end;
}

// ---- replay ----

static bool is_on_its_way(const Wave *wave, const Path *path)
{
    for (int i = 0; i < wave->count; i++) {
        if (wave->path[i] == path) {
            return true;
        }
    }
    return false;
}

static Vec3 gathered(const Path *path)
{
    return vec3_add(path->direct, path->indirect);
}

// Fills the end of the step from the vertex at which the path's ray arrived; NULL = at none.
static void note_end(PathStep *step, const Tracer *tracer, const Path *path, const Vertex *vertex,
                     bool goes_on)
{
    step->object = step->material = -1;
    if (!vertex) {
        step->end = goes_on ? STEP_MEDIUM : STEP_OUTSIDE;
        step->position = goes_on ? path->ray.origin : step->origin;
        return;
    }
    bool lamp = accel_light(tracer->accel, &vertex->hit) >= 0;
    step->end = lamp ? STEP_LAMP : STEP_SURFACE;
    step->position = vec3_madd(step->origin, vertex->hit.t, step->direction);
    if (!lamp) {
        step->normal = vertex->point.geometric_normal;
        step->object = vertex->point.object;
        step->material = vertex->point.material;
    }
}

// Advances the wave by one ray and describes that of one of its paths.
static void follow(Wave *wave, bool camera, const Path *path, PathStep *step)
{
    *step = (PathStep){.origin = path->ray.origin,
                       .direction = path->ray.direction,
                       .throughput = path->throughput};
    Vec3 before = gathered(path);
    int vertices = trace_rays(wave, camera);
    const Vertex *vertex = NULL;
    for (int i = 0; i < vertices; i++) {
        vertex = wave->vertex[i].path == path ? &wave->vertex[i] : vertex;
    }
    scatter_at_surfaces(wave, vertices);
    trace_shadows(wave->tracer->accel, &wave->shadows);
    note_end(step, wave->tracer, path, vertex, is_on_its_way(wave, path));
    step->light = vec3_sub(gathered(path), before);
}

int integrator_replay(const Tracer *tracer, int x, int y, int sample, PathStep step[], int most,
                      PathResult *result)
{
    int begin, end, steps = 0;
    integrator_wave(tracer, sample, &begin, &end);
    int count = end - begin;
    Path path[WAVE_SIZE];
    PathResult results[WAVE_SIZE];
    Wave wave;
    start_paths(tracer, x, y, begin, count, path, results, &wave);
    const Path *wanted = &path[sample - begin];
    for (bool camera = true; is_on_its_way(&wave, wanted); camera = false) {
        PathStep own;
        follow(&wave, camera, wanted, steps < most ? &step[steps] : &own);
        steps += steps < most;
    }
    finish(wanted, &results[sample - begin]);
    *result = results[sample - begin];
    return steps;
}
