// Shared by lights.c and sky_lights.c; private to them.
#ifndef RAMIFY_RENDER_LIGHT_LIGHTS_INTERNAL_H
#define RAMIFY_RENDER_LIGHT_LIGHTS_INTERNAL_H

#include "render/light/lights.h"
#include "render/sky/air.h"
#include "render/sky/painted_clouds.h"
#include "render/world.h"

// What is near is weighed by place up to so many lights: each is looked at for each choice.
enum { MOST_WEIGHED = 16 };

// A ball about a light.
typedef struct NearLight {
    Vec3 center;
    float square; // of its radius
    float power;  // flux
} NearLight;

struct Lights {
    const World *world;
    Vec3 constant; // SKY_CONSTANT: radiance
    Dome *dome;    // NULL without sky or environment
    Air *air;      // NULL where it is not seen
    Sun sun;
    Sun built_sun;                // before the sky was turned
    float built_rotation;         // of the dome
    float turn_cos, turn_sin;     // of the sky's rotation about +Y
    PaintedClouds clouds;         // as the sky was built: not turned
    Water *water;                 // NULL without any
    EmitterSet emitters;          // glowing geometry
    NearLight near[MOST_WEIGHED]; // the world's lights, then all emitters as one
    int near_count;               // 0 = there is nothing to weigh, or too much
    float *share; // chance to be chosen: of the world's lights, dome, sun, all emitters
    float *sum;   // count + 1: cumulated
    int count, dome_index, sun_index, emitters_index; // -1 = there is none
};

// sky_lights.c: sky, sun or moon, and the water that refracts their light. Needs lights->world;
// `lights` owns the results, also after a failure.
bool lights_make_above(Lights *lights, const Run *run, Error *e);

// light_choice.c. Fills near and near_count.
void lights_find_near(Lights *lights);

// By powers.
LightChoice lights_choose(const Lights *lights, float u);

// As lights_sample_mixed chooses.
LightChoice lights_choose_mixed(const Lights *lights, const LightReceiver *receiver, float near,
                                float u);

// The end point of a shadow ray from about `point` to a position on a light with this unit normal.
// extent: m, of the surface around it.
Vec3 lights_end(Vec3 place, Vec3 normal, float extent, Vec3 point);

// Samples light `index`, the dome or the sun; pdf without the probability of the choice.
bool lights_sample_above(const Lights *lights, int index, Vec3 point, const float u[2],
                         LightSample *sample);

// The weight of light found by BSDF sampling that light sampling finds with light_pdf.
static inline float lights_weight(float bsdf_pdf, float light_pdf)
{
    return bsdf_pdf > 0.0f ? power_heuristic(bsdf_pdf, light_pdf) : 1.0f;
}

#endif
