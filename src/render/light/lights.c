#include "render/light/lights_internal.h"

#include "base/memory.h"
#include "render/light/lamp.h"

#include <stdlib.h>

// Half by power, half uniform: a weak light may be the only one in a shadow.
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
            power = lamp_power(&lights->world->light[i], scene_radius);
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

Lights *lights_new(const World *world, float scene_radius, const Run *run, Error *e)
{
    Lights *lights = memory_alloc_zero(1, sizeof *lights, e);
    if (!lights) {
        return NULL;
    }
    lights->world = world;
    lights->turn_cos = 1.0f;
    lights->dome_index = lights->sun_index = lights->emitters_index = -1;
    if (!lights_make_above(lights, run, e) || !emitter_set_fill(&lights->emitters, world, run, e)) {
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
    lights_find_near(lights);
    return lights;
}

void lights_free(Lights *lights)
{
    if (lights) {
        dome_free(lights->dome);
        air_free(lights->air);
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

// ---- seen from a point

// A position just off a light's surface, on the side of its unit normal, where a shadow ray from
// about `point` ends before it meets the surface: the offset exceeds the rounding errors of the
// ray's end and of Embree's intersection, which grow with the distances of the surface's corners or
// centre.
Vec3 lights_end(Vec3 place, Vec3 normal, float extent, Vec3 point)
{
    float reach = vec3_largest(place) + vec3_distance(place, point) + extent;
    float rounding = 1e-6f * reach + 1e-8f;
    return vec3_madd(place, rounding, normal);
}

static void take_emitter_sample(const Lights *lights, int64_t emitter, Vec3 point,
                                const EmitterSample *on, float probability, LightSample *sample)
{
    const Emitter *e = &lights->emitters.emitter[emitter];
    const World *world = lights->world;
    const Material *m = &world->material[world->geometry.part[e->part].material];
    sample->direction = on->direction;
    sample->distance = on->distance;
    sample->end = lights_end(on->position, on->normal, on->extent, point);
    sample->slack = on->slack;
    sample->part = e->part;
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
    take_emitter_sample(lights, i, receiver->position, &on, probability, sample);
    return true;
}

// From a choice made for the receiver, or by powers.
static bool sample_chosen(const Lights *lights, const LightChoice *choice,
                          const LightReceiver *receiver, const float u[2], LightSample *sample)
{
    bool seen = true;
    if (!choice->near) {
        seen = lights_sample_above(lights, choice->index, receiver->position, u, sample);
    } else if (choice->index == lights->emitters_index) {
        seen = sample_emitters(lights, receiver, u, choice->rest, sample);
    } else {
        seen = lamp_sample(&lights->world->light[choice->index], receiver->position, u, sample);
    }
    sample->pdf *= lights->share[choice->index];
    return seen && sample->pdf > 0.0f;
}

bool lights_sample(const Lights *lights, const LightReceiver *receiver, const float u[3],
                   LightSample *sample)
{
    LightChoice choice = lights_choose(lights, u[2]);
    return sample_chosen(lights, &choice, receiver, u, sample);
}

bool lights_sample_mixed(const Lights *lights, const LightReceiver *receiver, float near,
                         const float u[3], LightSample *sample)
{
    LightChoice choice = lights_choose_mixed(lights, receiver, near, u[2]);
    bool seen = sample_chosen(lights, &choice, receiver, u, sample);
    sample->pdf *= choice.ratio * lights_mix(lights, near, choice.near);
    return seen && sample->pdf > 0.0f;
}

float lights_mean_above(const Lights *lights)
{
    float sky = lights->dome ? lights->dome->power : 4.0f * PI_F * luminance(lights->constant);
    float sun = luminance(lights->sun.radiance) * lights->sun.solid_angle;
    return (sky + sun) / (4.0f * PI_F);
}

// ---- along a segment

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
    take_emitter_sample(lights, i, point, &on, probability, &sample->light);
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
        seen = lights_sample_above(lights, choice->index, point, u, &sample->light);
        sample->pivot_pdf = 0.0f;
    } else if (choice->index == lights->emitters_index) {
        seen = sample_emitters_along(lights, choice, segment, pivot, point, u, sample);
    } else {
        const Light *light = &lights->world->light[choice->index];
        seen = lamp_sample(light, point, u, &sample->light);
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

Vec3 lights_emitted(const Lights *lights, int index, Vec3 origin, Vec3 direction, float distance,
                    float bsdf_pdf)
{
    const Light *light = &lights->world->light[index];
    float pdf = lamp_density(light, origin, direction, distance);
    if (!(pdf > 0.0f)) {
        return vec3_splat(0.0f); // the dark side
    }
    return vec3_scale(light->radiance, lights_weight(bsdf_pdf, pdf * lights->share[index]));
}

float lights_glow(const Lights *lights, const SurfacePlace *place, Vec3 position,
                  const LightReceiver *receiver, float bsdf_pdf)
{
    const EmitterSet *set = &lights->emitters;
    float glow = emitter_set_glow(lights->world, place);
    if (!set->tree) {
        return glow;
    }
    int64_t i = emitter_set_find(set, lights->world, place, position);
    if (!emitter_faces(&set->emitter[i], receiver->position)) {
        return 0.0f;
    }
    if (bsdf_pdf <= 0.0f) {
        return glow;
    }
    float pdf = emitter_pdf(&set->emitter[i], receiver->position, position);
    if (pdf > 0.0f) {
        pdf *= light_tree_probability(set->tree, receiver, i);
    }
    return glow * lights_weight(bsdf_pdf, pdf * lights->share[lights->emitters_index]);
}
