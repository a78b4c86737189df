#include "render/lights.h"

#include "base/memory.h"
#include "render/clouds.h"
#include "render/environment.h"
#include "render/night.h"
#include "render/sky.h"
#include "render/warp.h"

#include <stdlib.h>

struct Lights {
    const World *world;
    Vec3 constant; // SKY_CONSTANT: radiance
    Dome *dome;    // NULL without sky or environment
    Sun sun;
    Sun built_sun;            // before the sky was turned
    float built_rotation;     // of the dome
    float turn_cos, turn_sin; // of the sky's rotation about +Y
    Clouds clouds;            // as the sky was built: not turned
    Water *water;             // NULL without any
    EmitterSet emitters;      // glowing geometry
    float
        *share; // chance of each to be chosen: the world's lights, the dome, the sun, all emitters
    float *sum; // count + 1: cumulated
    int count, dome_index, sun_index, emitters_index; // -1 = there is none
};

// Power that reaches the scene, over pi^2 R^2 for a scene of radius R.
static float near_power(const Light *light, float scene_radius)
{
    float area = light->kind == LIGHT_QUAD ? vec3_length(vec3_cross(light->edge_u, light->edge_v))
                                           : 4.0f * PI_F * light->radius * light->radius;
    return luminance(light->radiance) * area / (scene_radius * scene_radius);
}

// Half by power, half evenly: what is weak on the whole may be all there is in a shadow.
static void fill_shares(Lights *lights, float scene_radius)
{
    double total = 0.0, lit = 0.0, sum = 0.0;
    for (int i = 0; i < lights->count; i++) {
        float power;
        if (lights->dome && i == lights->dome_index) {
            power = 0.5f * lights->dome->power / PI_F;
        } else if (i == lights->sun_index) {
            power = luminance(lights->sun.radiance) * lights->sun.solid_angle / PI_F;
        } else if (i == lights->emitters_index) {
            power = light_tree_power(lights->emitters.tree) / (PI_F * scene_radius * scene_radius);
        } else {
            power = near_power(&lights->world->light[i], scene_radius);
        }
        lights->share[i] = power;
        total += (double)power;
        lit += power > 0.0f ? 1.0 : 0.0;
    }
    for (int i = 0; i < lights->count; i++) {
        double power = (double)lights->share[i];
        lights->share[i] = power > 0.0 ? (float)(0.5 * power / total + 0.5 / lit) : 0.0f;
        lights->sum[i] = (float)sum;
        sum += (double)lights->share[i];
    }
    lights->sum[lights->count] = total > 0.0 ? 1.0f : 0.0f;
}

// Clouds are lit by the sun and by the sky's mean radiance half way up.
static Clouds make_clouds(const Lights *lights)
{
    const Sky *sky = &lights->world->sky;
    Clouds clouds = {.cover = sky->clouds,
                     .sun_direction = lights->sun.direction,
                     .sunlight = vec3_scale(lights->sun.radiance, lights->sun.solid_angle),
                     .seed = (uint32_t)lights->world->render.seed};
    const float half = 0.70710678f;
    const Vec3 around[4] = {{half, half, 0}, {-half, half, 0}, {0, half, half}, {0, half, -half}};
    for (int i = 0; i < 4; i++) {
        clouds.skylight = vec3_madd(clouds.skylight, 0.25f, dome_lookup(lights->dome, around[i]));
    }
    return clouds;
}

static bool make_sky(Lights *lights, const Run *run, Error *e)
{
    const Sky *sky = &lights->world->sky;
    switch (sky->kind) {
    case SKY_NONE:
        return true;
    case SKY_CONSTANT:
        lights->constant = vec3_scale(sky->color, sky->strength);
        return true;
    case SKY_SUN_SKY:
        lights->dome = sky_dome(sky, &lights->sun, run, e);
        if (lights->dome) {
            lights->clouds = make_clouds(lights);
        }
        break;
    case SKY_NIGHT:
        lights->dome = night_dome(sky, &lights->sun, e);
        break;
    case SKY_ENVIRONMENT:
        lights->dome = environment_dome(sky, e);
        break;
    }
    if (lights->dome) {
        lights->built_sun = lights->sun;
        lights->built_rotation = lights->dome->rotation;
        lights_turn_sky(lights);
    }
    return lights->dome != NULL;
}

// From azimuth 0 (+Z) toward 90 degrees (+X).
static Vec3 turned(Vec3 d, float cosine, float sine)
{
    return vec3(d.x * cosine + d.z * sine, d.y, d.z * cosine - d.x * sine);
}

// A direction of the world as the sky was built.
static Vec3 into_sky(const Lights *lights, Vec3 direction)
{
    return turned(direction, lights->turn_cos, -lights->turn_sin);
}

void lights_turn_sky(Lights *lights)
{
    float angle = lights->world->sky.rotation * RADIANS_PER_DEGREE;
    lights->turn_cos = cosf(angle);
    lights->turn_sin = sinf(angle);
    lights->sun.direction = turned(lights->built_sun.direction, lights->turn_cos, lights->turn_sin);
    if (lights->dome) {
        lights->dome->rotation = lights->built_rotation + angle;
    }
}

// The network of light is sharp at what the camera looks at.
static bool make_water(Lights *lights, const Run *run, Error *e)
{
    const World *world = lights->world;
    if (world->medium.kind != MEDIUM_WATER) {
        return true;
    }
    float depth = world->medium.height - world->camera.target.y;
    depth = depth > 0.0f ? depth : fmaxf(world->medium.height - world->camera.position.y, 1.0f);
    float sun_radius = sqrtf(lights->sun.solid_angle / PI_F);
    lights->water = water_new(&world->medium, lights->sun.direction, sun_radius, depth,
                              world->render.seed, run, e);
    return lights->water != NULL;
}

Lights *lights_new(const World *world, float scene_radius, const Run *run, Error *e)
{
    Lights *lights = memory_alloc_zero(1, sizeof *lights, e);
    if (!lights) {
        return NULL;
    }
    lights->world = world;
    lights->turn_cos = 1.0f;
    lights->dome_index = lights->sun_index = lights->emitters_index = -1;
    if (!make_sky(lights, run, e) || !make_water(lights, run, e) ||
        !emitter_set_fill(&lights->emitters, world, e)) {
        lights_free(lights);
        return NULL;
    }
    lights->count = world->light_count;
    if (lights->dome) {
        lights->dome_index = lights->count++;
    }
    if (luminance(lights->sun.radiance) > 0.0f) {
        lights->sun_index = lights->count++;
    }
    if (lights->emitters.tree) {
        lights->emitters_index = lights->count++;
    }
    if (!(lights->share = memory_alloc_zero(lights->count, sizeof(float), e)) ||
        !(lights->sum = memory_alloc_zero(lights->count + 1, sizeof(float), e))) {
        lights_free(lights);
        return NULL;
    }
    fill_shares(lights, fmaxf(scene_radius, 1e-6f));
    return lights;
}

void lights_free(Lights *lights)
{
    if (lights) {
        dome_free(lights->dome);
        water_free(lights->water);
        emitter_set_clear(&lights->emitters);
        free(lights->share);
        free(lights->sum);
        free(lights);
    }
}

bool lights_can_sample(const Lights *lights)
{
    return lights->sum[lights->count] > 0.0f;
}

// ---- quads and spheres

// Density per steradian at which a uniform point of the quad lies in this direction.
static float quad_density(const Light *light, Vec3 direction, float distance)
{
    Vec3 normal = vec3_cross(light->edge_u, light->edge_v); // length: the area
    float facing = -vec3_dot(normal, direction);
    return facing > 0.0f ? distance * distance / facing : 0.0f;
}

static bool quad_sample(const Light *light, Vec3 point, const float u[2], LightSample *sample)
{
    Vec3 on = vec3_madd(vec3_madd(light->corner, u[0], light->edge_u), u[1], light->edge_v);
    Vec3 to = vec3_sub(on, point);
    sample->distance = vec3_length(to);
    if (!(sample->distance > 0.0f)) {
        return false;
    }
    sample->direction = vec3_scale(to, 1.0f / sample->distance);
    sample->pdf = quad_density(light, sample->direction, sample->distance);
    return sample->pdf > 0.0f;
}

// 1 - cosine of the half angle under which the sphere is seen; 2 from inside: all directions.
static float sphere_one_minus_cos(const Light *light, Vec3 point)
{
    Vec3 to = vec3_sub(light->center, point);
    float s2 = light->radius * light->radius / vec3_dot(to, to);
    return s2 < 1.0f ? s2 / (1.0f + sqrtf(1.0f - s2)) : 2.0f;
}

static bool sphere_sample(const Light *light, Vec3 point, const float u[2], LightSample *sample)
{
    Vec3 to = vec3_sub(light->center, point);
    float cap = sphere_one_minus_cos(light, point), off = u[0] * cap;
    Vec3 axis = vec3_normalize(to);
    axis = vec3_dot(axis, axis) > 0.0f ? axis : vec3(0.0f, 1.0f, 0.0f);
    sample->direction = warp_cone(axis, 1.0f - off, sqrtf(fmaxf(0.0f, off * (2.0f - off))), u[1]);
    float along = vec3_dot(to, sample->direction);
    Vec3 aside = vec3_madd(to, -along, sample->direction);
    float half = sqrtf(fmaxf(0.0f, light->radius * light->radius - vec3_dot(aside, aside)));
    sample->distance = cap < 2.0f ? along - half : along + half;
    sample->pdf = 1.0f / (2.0f * PI_F * cap);
    return sample->distance > 0.0f;
}

// ---- all together

LightChoice lights_choose(const Lights *lights, float u)
{
    int low = 0, high = lights->count;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (lights->sum[middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    float rest = fminf((u - lights->sum[low]) / lights->share[low], 0.99999994f);
    return (LightChoice){low, rest, low != lights->dome_index && low != lights->sun_index};
}

static void take_emitter_sample(const Lights *lights, int64_t emitter, const EmitterSample *on,
                                float probability, LightSample *sample)
{
    const Material *m = &lights->world->material[lights->emitters.emitter[emitter].material];
    sample->direction = on->direction;
    sample->distance = on->distance;
    sample->far = fmaxf(on->distance * 0.999f - on->slack, 0.0f);
    sample->radiance = vec3_scale(m->radiance, on->glow);
    sample->pdf = on->pdf * probability;
}

static bool sample_emitters(const Lights *lights, const LightReceiver *receiver, const float u[2],
                            float choice, LightSample *sample)
{
    float probability;
    int64_t i = light_tree_sample(lights->emitters.tree, receiver, choice, &probability);
    EmitterSample on;
    if (i < 0 || !emitter_sample(&lights->emitters.emitter[i], receiver->position, u, &on)) {
        return false;
    }
    take_emitter_sample(lights, i, &on, probability, sample);
    return true;
}

static bool sample_lamp(const Light *light, Vec3 point, const float u[2], LightSample *sample)
{
    sample->radiance = light->radiance;
    bool seen = light->kind == LIGHT_QUAD ? quad_sample(light, point, u, sample)
                                          : sphere_sample(light, point, u, sample);
    sample->far = sample->distance * 0.999f;
    return seen;
}

// Bends what comes from above the water down to a point in it.
static bool into_water(const Lights *lights, Vec3 point, bool sun, LightSample *sample)
{
    WaterPassage passage;
    if (!water_enter(sample->direction, &passage)) {
        return false;
    }
    float scale = WATER_INDEX * WATER_INDEX * passage.share;
    scale *= sun ? water_caustic(lights->water, point) : 1.0f;
    sample->radiance = vec3_scale(sample->radiance, scale);
    sample->direction = passage.direction;
    sample->pdf *= passage.shrink;
    return true;
}

// Sky and sun.
static bool sample_far(const Lights *lights, int index, Vec3 point, const float u[2],
                       LightSample *sample)
{
    sample->distance = sample->far = INFINITY;
    if (index == lights->dome_index) {
        sample->direction = dome_sample(lights->dome, u[0], u[1], &sample->pdf);
        sample->radiance = dome_lookup(lights->dome, sample->direction);
    } else {
        sample->direction = sun_sample(&lights->sun, u[0], u[1]);
        sample->radiance = sun_radiance(&lights->sun, sample->direction);
        sample->pdf = 1.0f / lights->sun.solid_angle;
    }
    return !water_covers(lights->water, point) ||
           into_water(lights, point, index == lights->sun_index, sample);
}

bool lights_sample(const Lights *lights, const LightReceiver *receiver, const float u[3],
                   LightSample *sample)
{
    LightChoice choice = lights_choose(lights, u[2]);
    bool seen = true;
    if (!choice.near) {
        seen = sample_far(lights, choice.index, receiver->position, u, sample);
    } else if (choice.index == lights->emitters_index) {
        seen = sample_emitters(lights, receiver, u, choice.rest, sample);
    } else {
        seen = sample_lamp(&lights->world->light[choice.index], receiver->position, u, sample);
    }
    sample->pdf *= lights->share[choice.index];
    return seen && sample->pdf > 0.0f;
}

// ---- along a segment

static Vec3 lamp_pivot(const Light *light, const float u[2])
{
    return light->kind == LIGHT_QUAD
               ? vec3_madd(vec3_madd(light->corner, u[0], light->edge_u), u[1], light->edge_v)
               : light->center;
}

bool lights_draw_pivot(const Lights *lights, const LightChoice *choice, const LightSegment *segment,
                       const float u[2], LightPivot *pivot)
{
    if (choice->index != lights->emitters_index) {
        *pivot = (LightPivot){-1, 1.0f, lamp_pivot(&lights->world->light[choice->index], u)};
        return true;
    }
    pivot->emitter = light_tree_sample_segment(lights->emitters.tree, segment, choice->rest,
                                               &pivot->probability);
    if (pivot->emitter >= 0) {
        pivot->position = emitter_pivot(&lights->emitters.emitter[pivot->emitter], u);
    }
    return pivot->emitter >= 0;
}

static bool sample_emitters_along(const Lights *lights, const LightChoice *choice,
                                  const LightSegment *segment, const LightPivot *pivot, Vec3 point,
                                  const float u[2], SegmentLight *sample)
{
    const LightTree *tree = lights->emitters.tree;
    LightReceiver receiver = {.position = point};
    float probability = 0.0f;
    int64_t i =
        pivot ? pivot->emitter : light_tree_sample(tree, &receiver, choice->rest, &probability);
    EmitterSample on;
    const Emitter *emitter = &lights->emitters.emitter[i < 0 ? 0 : i];
    if (i < 0 || !(pivot ? emitter_sample_pivoted(emitter, point, u, &on)
                         : emitter_sample(emitter, point, u, &on))) {
        return false;
    }
    if (pivot) {
        probability = light_tree_probability(tree, &receiver, i);
    }
    take_emitter_sample(lights, i, &on, probability, &sample->light);
    float along = pivot ? pivot->probability : light_tree_probability_segment(tree, segment, i);
    sample->pivot = (LightPivot){i, along, on.pivot};
    sample->pivot_pdf = along * on.pdf * on.pivot_ratio;
    return true;
}

bool lights_sample_chosen(const Lights *lights, const LightChoice *choice,
                          const LightSegment *segment, const LightPivot *pivot, Vec3 point,
                          const float u[2], SegmentLight *sample)
{
    float share = lights->share[choice->index];
    bool seen;
    if (!choice->near) {
        seen = sample_far(lights, choice->index, point, u, &sample->light);
        sample->pivot_pdf = 0.0f;
    } else if (choice->index == lights->emitters_index) {
        seen = sample_emitters_along(lights, choice, segment, pivot, point, u, sample);
    } else {
        const Light *light = &lights->world->light[choice->index];
        seen = sample_lamp(light, point, u, &sample->light);
        sample->pivot = (LightPivot){-1, 1.0f, lamp_pivot(light, u)};
        sample->pivot_pdf = sample->light.pdf;
    }
    if (!seen) {
        return false;
    }
    sample->light.pdf *= share;
    sample->pivot_pdf *= share;
    return sample->light.pdf + sample->pivot_pdf > 0.0f;
}

static float bsdf_weight(float bsdf_pdf, float light_pdf)
{
    return bsdf_pdf > 0.0f ? power_heuristic(bsdf_pdf, light_pdf) : 1.0f;
}

const Water *lights_water(const Lights *lights)
{
    return lights->water;
}

// What only the camera and mirrors see: clouds, stars, the face of the moon.
static Vec3 seen_above(const Lights *lights, Vec3 direction, float spread)
{
    const Sky *sky = &lights->world->sky;
    Vec3 above = into_sky(lights, direction);
    Vec3 sum = clouds_before(&lights->clouds, above, dome_lookup(lights->dome, direction));
    bool covered = lights->sun_index >= 0 && sun_covers(&lights->sun, direction);
    if (sky->kind == SKY_NIGHT && !covered) {
        sum = vec3_add(sum, night_stars(sky, above, spread));
    }
    if (covered) {
        float face = lights->sun.even ? night_moon_face(&lights->built_sun, above) : 1.0f;
        sum = vec3_madd(sum, face, sun_radiance(&lights->sun, direction));
    }
    return sum;
}

// As light, weighted; shrink: see WaterPassage.
static Vec3 light_above(const Lights *lights, Vec3 direction, float bsdf_pdf, float shrink,
                        float sun_share)
{
    float pdf = dome_density(lights->dome, direction) * lights->share[lights->dome_index] * shrink;
    Vec3 sum = vec3_scale(dome_lookup(lights->dome, direction), bsdf_weight(bsdf_pdf, pdf));
    if (lights->sun_index >= 0 && sun_covers(&lights->sun, direction)) {
        pdf = lights->share[lights->sun_index] / lights->sun.solid_angle * shrink;
        sum = vec3_madd(sum, bsdf_weight(bsdf_pdf, pdf) * sun_share,
                        sun_radiance(&lights->sun, direction));
    }
    return sum;
}

// The sun through waves, to the eye: spread over a few degrees instead of into glints, which no
// number of samples would settle.
static Vec3 glitter(const Lights *lights, Vec3 direction)
{
    const float spread = 0.03f; // radians
    Vec3 off = vec3_sub(direction, lights->sun.direction);
    float share = expf(-0.5f * vec3_dot(off, off) / (spread * spread));
    float solid_angle = 2.0f * PI_F * spread * spread;
    return vec3_scale(lights->sun.radiance, share * lights->sun.solid_angle / solid_angle);
}

static Vec3 background_from_water(const Lights *lights, Vec3 from, Vec3 direction, float bsdf_pdf,
                                  float spread)
{
    WaterPassage passage;
    bool eye = bsdf_pdf <= 0.0f;
    Vec3 normal = vec3(0.0f, 1.0f, 0.0f);
    if (eye && direction.y > 0.0f) {
        float t = (lights->world->medium.height - from.y) / direction.y;
        normal = water_normal(lights->water, vec3_madd(from, t, direction));
    }
    if (!water_leave(direction, normal, &passage)) {
        return vec3_splat(0.0f);
    }
    Vec3 above = lights->constant;
    if (lights->dome && eye && lights->world->sky.kind == SKY_SUN_SKY) {
        above = clouds_before(&lights->clouds, into_sky(lights, passage.direction),
                              dome_lookup(lights->dome, passage.direction));
        above = vec3_add(above, glitter(lights, passage.direction));
    } else if (lights->dome && eye) {
        above = seen_above(lights, passage.direction, spread);
    } else if (lights->dome) {
        above = light_above(lights, passage.direction, bsdf_pdf, passage.shrink,
                            water_caustic(lights->water, from));
    }
    return vec3_scale(above, WATER_INDEX * WATER_INDEX * passage.share);
}

Vec3 lights_background(const Lights *lights, Vec3 from, Vec3 direction, float bsdf_pdf,
                       float spread)
{
    if (water_covers(lights->water, from)) {
        return background_from_water(lights, from, direction, bsdf_pdf, spread);
    }
    if (!lights->dome) {
        return lights->constant;
    }
    return bsdf_pdf > 0.0f ? light_above(lights, direction, bsdf_pdf, 1.0f, 1.0f)
                           : seen_above(lights, direction, spread);
}

Vec3 lights_emitted(const Lights *lights, int index, Vec3 origin, Vec3 direction, float distance,
                    float bsdf_pdf)
{
    const Light *light = &lights->world->light[index];
    float pdf;
    if (light->kind == LIGHT_QUAD) {
        pdf = quad_density(light, direction, distance);
        if (!(pdf > 0.0f)) {
            return vec3_splat(0.0f); // the dark side
        }
    } else {
        pdf = 1.0f / (2.0f * PI_F * sphere_one_minus_cos(light, origin));
    }
    return vec3_scale(light->radiance, bsdf_weight(bsdf_pdf, pdf * lights->share[index]));
}

float lights_glow(const Lights *lights, const SurfacePlace *place, Vec3 position,
                  const LightReceiver *receiver, float bsdf_pdf)
{
    const EmitterSet *set = &lights->emitters;
    float glow = emitter_set_glow(lights->world, place);
    if (bsdf_pdf <= 0.0f || !set->tree) {
        return glow;
    }
    int64_t i = emitter_set_find(set, lights->world, place, position);
    float pdf = emitter_pdf(&set->emitter[i], receiver->position, position);
    if (pdf > 0.0f) {
        pdf *= light_tree_probability(set->tree, receiver, i);
    }
    return glow * bsdf_weight(bsdf_pdf, pdf * lights->share[lights->emitters_index]);
}

const Sun *lights_sun(const Lights *lights)
{
    return lights->sun_index >= 0 ? &lights->sun : NULL;
}

Vec3 lights_horizon(const Lights *lights, Vec3 direction)
{
    if (!lights->dome) {
        return lights->constant;
    }
    float level = sqrtf(direction.x * direction.x + direction.z * direction.z);
    float rise = 0.02f * fmaxf(level, 1e-3f); // a degree up: the air, not the ground
    return dome_lookup(lights->dome, vec3_normalize(vec3(direction.x, rise, direction.z)));
}
