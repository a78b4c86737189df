#include "render/renderer.h"

#include "base/memory.h"
#include "base/random.h"
#include "render/probe.h"
#include "render/tiles.h"
#include "render/world.h"

#include <stdlib.h>

struct Renderer {
    const World *world;
    MaterialSet *materials;
    Accel *accel;
    Lights *lights;
    CloudSet *clouds;      // NULL = none
    RainPhase *rain;       // NULL = no shower
    LampField *lamp_field; // NULL = none
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

static bool build_clouds(Renderer *renderer, const Run *run, Error *e)
{
    const World *world = renderer->world;
    clouds_free(renderer->clouds);
    renderer->clouds = NULL;
    if (world->cloud_count == 0) {
        return true;
    }
    renderer->clouds = clouds_new(world->cloud, world->cloud_count, world->cloud_seed, run, e);
    return renderer->clouds;
}

static bool build_rain(Renderer *renderer, Error *e)
{
    if (renderer->world->shower_count > 0 && !renderer->rain) {
        renderer->rain = rain_phase_new(e);
        return renderer->rain;
    }
    return true;
}

static bool build_accel(Renderer *renderer, const Run *run, Error *e)
{
    accel_free(renderer->accel); // first, because two may not fit in memory
    renderer->accel = accel_new(renderer->world, renderer->materials, renderer->isa, run, e);
    return renderer->accel;
}

// A world holds every built-in material; tables are made only for those that parts use.
static MaterialSet *prepare_materials(const World *world, const Run *run, Error *e)
{
    bool *used = memory_alloc_zero(world->material_count, sizeof *used, e);
    if (!used) {
        return NULL;
    }
    for (int64_t i = 0; i < world->geometry.count; i++) {
        used[world->geometry.part[i].material] = true;
    }
    MaterialSet *set = material_set_new(world->material, used, world->material_count, run, e);
    free(used);
    if (set) {
        material_set_use_masks(set, &world->masks);
    }
    return set;
}

static void fill_tracer(Tracer *tracer, const Renderer *renderer);

// Of all that the tracer holds.
static bool build_lamp_field(Renderer *renderer, const Run *run, Error *e)
{
    lamp_field_free(renderer->lamp_field);
    renderer->lamp_field = NULL;
    if (!renderer->world->render.lamp_field) {
        return true;
    }
    Tracer *tracer = memory_alloc_zero(1, sizeof *tracer, e);
    if (!tracer) {
        return false;
    }
    fill_tracer(tracer, renderer);
    uint64_t key = random_key(renderer->world->cloud_seed, 0x1a3b);
    bool done = lamp_field_make(&renderer->lamp_field, tracer, key, run, e);
    free(tracer);
    return done;
}

Renderer *renderer_new(const World *world, const char *isa, const Run *run, Error *e)
{
    Renderer *renderer = memory_alloc_zero(1, sizeof *renderer, e);
    if (!renderer) {
        return NULL;
    }
    renderer->world = world;
    renderer->isa = isa;
    renderer->materials = prepare_materials(world, run, e);
    if (!renderer->materials || !build_accel(renderer, run, e) || !build_lights(renderer, run, e) ||
        !build_clouds(renderer, run, e) || !build_rain(renderer, e) ||
        !build_lamp_field(renderer, run, e)) {
        renderer_free(renderer);
        return NULL;
    }
    return renderer;
}

bool renderer_update(Renderer *renderer, unsigned changed, const Run *run, Error *e)
{
    const World *world = renderer->world;
    if (changed & RENDERER_MATERIALS) {
        MaterialSet *fresh = prepare_materials(world, run, e);
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
    if (changed & RENDERER_CLOUDS && !build_clouds(renderer, run, e)) {
        return false;
    }
    unsigned lit = changed & (RENDERER_CLOUDS | RENDERER_LAMPS | RENDERER_MATERIALS);
    if ((world->medium.kind == MEDIUM_NONE) == !renderer->lamp_field) { // a medium came or went
        lit |= changed & RENDERER_LIGHT;
    }
    changed &= ~(unsigned)RENDERER_CLOUDS;
    if (changed == RENDERER_SKY_TURNED && !lights_water(renderer->lights)) {
        lights_turn_sky(renderer->lights);
        return true;
    }
    return (changed == 0 || (build_lights(renderer, run, e) && build_rain(renderer, e))) &&
           (lit == 0 || build_lamp_field(renderer, run, e));
}

void renderer_free(Renderer *renderer)
{
    if (renderer) {
        lamp_field_free(renderer->lamp_field);
        clouds_free(renderer->clouds);
        free(renderer->rain);
        lights_free(renderer->lights);
        accel_free(renderer->accel);
        material_set_free(renderer->materials);
        free(renderer);
    }
}

static bool check_sizes(const World *world, const Film *film, Error *e)
{
    if (film->width != world->film.width || film->height != world->film.height) {
        return error_set(e, ERROR_INTERNAL, "a film of %d x %d pixels for a picture of %d x %d",
                         film->width, film->height, world->film.width, world->film.height);
    }
    if (world->render.samples < 1) {
        return error_set(e, ERROR_INPUT, "%d samples a pixel; at least 1 is needed",
                         world->render.samples);
    }
    if (world->render.first_sample >= render_end(&world->render)) {
        return error_set(e, ERROR_INPUT, "samples %d to %d of a pixel are none",
                         world->render.first_sample, render_end(&world->render) - 1);
    }
    return true;
}

// Without air in front of them, clouds fade all the same: clean air scatters green light to 1 / e
// in 80 km; haze adds to it with the turbidity.
static float cloud_haze(const Sky *sky)
{
    if (sky->haze_distance > 0.0f || sky->aerial_perspective > 0.0f) {
        return sky->haze_distance;
    }
    return 110e3f / fmaxf(sky->turbidity, 1.0f);
}

// um: of droplets in clouds; 10 to 30 (Miles, Verlinde and Clothiaux 2000).
static const float CLOUD_DROPLET = 20.0f;

static void fill_rain(Rain *rain, const Renderer *renderer)
{
    const World *world = renderer->world;
    rain->count = world->shower_count;
    rain->phase = renderer->rain;
    for (int i = 0; i < world->shower_count; i++) {
        rain->shaft[i] = rain_shaft(&world->shower[i], random_key(world->cloud_seed, (uint64_t)i));
    }
}

static void fill_tracer(Tracer *tracer, const Renderer *renderer)
{
    const World *world = renderer->world;
    const RenderParams *params = &world->render;
    tracer->world = world;
    tracer->accel = renderer->accel;
    tracer->lights = renderer->lights;
    tracer->clouds = renderer->clouds;
    tracer->lamp_field = renderer->lamp_field;
    tracer->droplets = droplet_phase(CLOUD_DROPLET);
    fill_rain(&tracer->rain, renderer);
    tracer->cloud_haze = cloud_haze(&world->sky);
    tracer->materials = renderer->materials;
    tracer->camera = camera_frame(&world->camera, world->film.width, world->film.height);
    uint64_t seed =
        params->noise_seed ? random_key(params->seed, params->noise_seed) : params->seed;
    tracer->planned = render_planned(params);
    sample_plan_fill(&tracer->plan, seed, tracer->planned);
    filter_fill(&tracer->filter, world->film.filter, world->film.filter_radius);
    tracer_set_media(tracer, accel_bounds(renderer->accel));
}

static Tracer *make_tracer(const Renderer *renderer, const Film *film, Error *e)
{
    Tracer *tracer =
        check_sizes(renderer->world, film, e) ? memory_alloc_zero(1, sizeof *tracer, e) : NULL;
    if (tracer) {
        fill_tracer(tracer, renderer);
    }
    return tracer;
}

bool renderer_look(Renderer *renderer, Film *film, const Run *run, Error *e)
{
    Tracer *tracer = make_tracer(renderer, film, e);
    film_drop_denoised(film);
    bool done = tracer && tiles_look(tracer, film, run, e);
    free(tracer);
    return done;
}

bool renderer_resume(Renderer *renderer, Film *film, const Run *run, RenderPass *pass, double every,
                     void *user, RenderStats *stats, Error *e)
{
    Tracer *tracer = make_tracer(renderer, film, e);
    if (!tracer) {
        return false;
    }
    film_drop_denoised(film);
    bool done = tiles_render(tracer, film, run, pass, every, user, stats, e);
    stats->memory = accel_bytes(renderer->accel);
    free(tracer);
    return done;
}

bool renderer_render(Renderer *renderer, Film *film, const Run *run, RenderPass *pass, void *user,
                     RenderStats *stats, Error *e)
{
    if (!check_sizes(renderer->world, film, e)) {
        return false;
    }
    film_forget(film, renderer->world->film.crop);
    return renderer_resume(renderer, film, run, pass, 0.0, user, stats, e);
}

bool renderer_probe(const Renderer *renderer, const Run *run, PathCosts *costs, Error *e)
{
    Tracer *tracer = memory_alloc_zero(1, sizeof *tracer, e);
    if (!tracer) {
        return false;
    }
    fill_tracer(tracer, renderer);
    bool done = probe_paths(tracer, run, costs, e);
    free(tracer);
    return done;
}

int renderer_replay(const Renderer *renderer, int x, int y, int sample, PathStep *step, int most,
                    Vec3 *color, Error *e)
{
    const FilmParams *film = &renderer->world->film;
    int samples = renderer->world->render.samples;
    if (x < 0 || y < 0 || x >= film->width || y >= film->height || sample < 0 ||
        sample >= samples) {
        error_set(e, ERROR_INPUT,
                  "no sample %d of pixel %d, %d; the picture has %d x %d pixels of %d samples, "
                  "counted from 0",
                  sample, x, y, film->width, film->height, samples);
        return -1;
    }
    Tracer *tracer = memory_alloc_zero(1, sizeof *tracer, e);
    if (!tracer) {
        return -1;
    }
    fill_tracer(tracer, renderer);
    PathResult result;
    unsigned state = accel_thread_begin();
    int steps = integrator_replay(tracer, x, y, sample, step, most, &result);
    accel_thread_end(state);
    free(tracer);
    *color = result.color;
    return steps;
}
