// All emitters: sky, sun, environment, lamps and glowing geometry. Each can be sampled and
// evaluated, so that the integrator combines both by multiple importance sampling.
#ifndef RAMIFY_RENDER_LIGHT_LIGHTS_H
#define RAMIFY_RENDER_LIGHT_LIGHTS_H

#include "base/run.h"
#include "render/light/emitter_set.h"
#include "render/medium/water.h"
#include "render/sky/air.h"
#include "render/sky/sun_sky.h"

typedef struct World World;
typedef struct Lights Lights;

// scene_radius (m): weighs lights at infinity against near ones in the choice of a light.
Lights *lights_new(const World *world, float scene_radius, const Run *run, Error *e);
void lights_free(Lights *lights); // NULL is fine

// Rotates sun, moon, clouds, stars and dome to the world's sky.rotation. Water keeps its caustics.
void lights_turn_sky(Lights *lights);

typedef struct LightSample {
    Vec3 direction; // unit, toward the light
    float distance; // m; INFINITY for sky and sun
    Vec3 end;       // of a near light: where shadow rays end, just off its surface
    float slack;    // m: how far before `end` the glowing curves of `part` cast no shadow
    int part;       // of glowing geometry; -1 of other lights
    Vec3 radiance;
    float pdf; // per steradian, with the choice of the light in it
} LightSample;

// True if light sampling helps. A sky of one colour is found as well by BSDF sampling.
bool lights_can_sample(const Lights *lights);

// False when the chosen light cannot be seen from the receiver.
bool lights_sample(const Lights *lights, const LightReceiver *receiver, const float u[3],
                   LightSample *sample);

// The same with a chance `near` of 0 .. 1 that a lamp or glowing geometry is chosen, and not sky or
// sun, where the receiver's place tells more than the powers do. NEAR_BY_POWER: lights_sample.
#define NEAR_BY_POWER (-1.0f)
// Lamps and glowing geometry are chosen by what they bring to the receiver, and not only by their
// powers.
bool lights_sample_mixed(const Lights *lights, const LightReceiver *receiver, float near,
                         const float u[3], LightSample *sample);

// How many times as often this lamp (-1: glowing geometry) is chosen there as by powers.
float lights_ratio(const Lights *lights, const LightReceiver *receiver, int index);

// How many times as often lights_sample_mixed chooses what is near (or sky and sun) as
// lights_sample: the density with which a direction was drawn, over this factor, has the weight
// against light sampling that it must have.
float lights_mix(const Lights *lights, float near, bool is_near);

// Mean luminance of sky and sun over all directions.
float lights_mean_above(const Lights *lights);

// ---- light that a medium scatters along a stretch of a ray

// A light chosen with a uniform number. near: it can also be sampled from a pivot.
typedef struct LightChoice {
    int index;
    float rest;  // of the uniform number
    bool near;   // a lamp or glowing geometry, not sky and sun
    float ratio; // of the chance to that by powers, which lights_sample_chosen has in its densities
} LightChoice;

// What is near is chosen by how much of it the medium scatters along the segment.
LightChoice lights_choose_along(const Lights *lights, const LightSegment *segment, float u);

// A place on the chosen near light, drawn before the point that it lights is known.
typedef struct LightPivot {
    int64_t emitter;   // of glowing geometry
    float probability; // of drawing that emitter for the segment
    Vec3 position;
} LightPivot;

bool lights_draw_pivot(const Lights *lights, const LightChoice *choice, const LightSegment *segment,
                       const float u[2], LightPivot *pivot);

// A sample of the chosen light from a point of the segment.
typedef struct SegmentLight {
    LightSample light; // with the density of lights_sample
    LightPivot pivot;  // of a near light: the pivot that was or would have been drawn
    float pivot_pdf;   // per steradian: the density by way of the pivot
} SegmentLight;

// pivot: NULL = draw anew from the point. u must be that of the pivot.
bool lights_sample_chosen(const Lights *lights, const LightChoice *choice,
                          const LightSegment *segment, const LightPivot *pivot, Vec3 point,
                          const float u[2], SegmentLight *sample);

// ----

// A ray that leaves the scene.
typedef struct BackgroundRay {
    Vec3 from; // where the direction was drawn, since water above it refracts
    Vec3 direction;
    float bsdf_pdf; // > 0: the density with which the direction was drawn; the radiance is weighted
                    // against light sampling by the power heuristic (Veach 1997); else unweighted
    float spread;   // radians over which stars are smoothed
} BackgroundRay;

// Radiance of sky and sun along each of 1 .. BACKGROUND_LIMIT rays. Together they wait for memory
// once instead of one after the other.
enum { BACKGROUND_LIMIT = 16 };
void lights_background_many(const Lights *lights, const BackgroundRay ray[], int count,
                            Vec3 radiance[]);

// The same for one ray.
static inline Vec3 lights_background(const Lights *lights, Vec3 from, Vec3 direction,
                                     float bsdf_pdf, float spread)
{
    BackgroundRay ray = {from, direction, bsdf_pdf, spread};
    Vec3 radiance;
    lights_background_many(lights, &ray, 1, &radiance);
    return radiance;
}

// The water above the scene; NULL if there is none.
const Water *lights_water(const Lights *lights);

// The same for a ray from `origin` that hits lamp `index` after `distance` m.
Vec3 lights_emitted(const Lights *lights, int index, Vec3 origin, Vec3 direction, float distance,
                    float bsdf_pdf);

// Factor on the material's radiance where a ray hits emitting geometry at `position`: its glow,
// weighted as above; bsdf_pdf was drawn at the receiver.
float lights_glow(const Lights *lights, const SurfacePlace *place, Vec3 position,
                  const LightReceiver *receiver, float bsdf_pdf);

// The sun by day, the moon by night; NULL where neither shines.
const Sun *lights_sun(const Lights *lights);

// What air does to what is seen along a ray; u: uniform. False without aerial perspective.
bool lights_air(const Lights *lights, Vec3 from, Vec3 direction, float distance, float u,
                AirView *view);

// The colour of haze when looking along direction.
Vec3 lights_horizon(const Lights *lights, Vec3 direction);

// Veach's power heuristic, exponent 2, for the density `a` against `b`.
static inline float power_heuristic(float a, float b)
{
    return a > 0.0f ? 1.0f / (1.0f + (b / a) * (b / a)) : 0.0f;
}

#endif
