// Path tracing: next-event estimation, multiple importance sampling, Russian roulette. Each path is
// a pure function of (tracer, pixel, sample).
#ifndef RAMIFY_RENDER_INTEGRATOR_H
#define RAMIFY_RENDER_INTEGRATOR_H

#include "render/accel/accel.h"
#include "render/camera.h"
#include "render/cloud/clouds.h"
#include "render/filter.h"
#include "render/lamp_field.h"
#include "render/light/lights.h"
#include "render/medium/droplets.h"
#include "render/rain/rain.h"
#include "render/rain/rain_phase.h"
#include "render/sampler.h"
#include "render/world.h"

// All showers of the scene.
typedef struct Rain {
    RainShaft shaft[RAIN_MOST_SHOWERS];
    int count;
    const RainPhase *phase; // borrowed; NULL without showers
} Rain;

// The data that all paths share; read only.
typedef struct Tracer {
    const World *world;
    const Accel *accel;
    const Lights *lights;
    const MaterialSet *materials;
    Filling outside; // the scene's medium
    Vec3 center;     // of the scene
    float medium_radius;
    bool has_passable;      // light goes straight on through some part: index-matched, open water
    bool has_glow;          // lamps, or parts that glow
    const CloudSet *clouds; // NULL = none
    DropletPhase droplets;  // of clouds
    const LampField *lamp_field; // light of lamps in clouds; NULL = paths find it all
    Rain rain;
    float cloud_haze; // m over which distance fades clouds to 1 / e
    CameraFrame camera;
    Filter filter;
    SamplePlan plan;
    int planned; // samples for which it was made
} Tracer;

// What a camera ray meets first.
typedef enum SeenKind {
    SEEN_SURFACE,
    SEEN_SKY,
    SEEN_LIGHT // a lamp, glowing geometry, the sun or the moon
} SeenKind;

// The estimate of one path. albedo and the fields below it describe the first surface.
typedef struct PathResult {
    Vec3 color;
    float alpha;
    int64_t rays;
    SeenKind seen;
    float sharpness; // 1, or less where the lens blurs by more than a pixel
    bool hit;
    Vec3 albedo, normal, position;
    float depth; // m along the ray
    int object;
} PathResult;

// Fills outside, center, medium_radius, has_passable and has_glow. bounds: of the scene.
void tracer_set_media(Tracer *tracer, Aabb bounds);

// Traces samples sample .. sample + count - 1 of pixel (x, y) together, count <= WAVE_SIZE.
enum { WAVE_SIZE = 16 };
void integrator_paths(const Tracer *tracer, int x, int y, int sample, int count,
                      PathResult result[]);

// One ray of a path, for a person to read.
typedef enum StepEnd {
    STEP_SURFACE, // it met a surface
    STEP_LAMP,    // it met a lamp
    STEP_MEDIUM,  // the path was scattered within a medium, or reflected under water
    STEP_OUTSIDE  // it left the scene, or its path ended within a medium
} StepEnd;

typedef struct PathStep {
    Vec3 origin, direction; // of the ray
    StepEnd end;
    Vec3 position, normal; // of the end; the normal (shading) of a surface alone
    int object, material;  // of a surface, else -1
    Vec3 throughput;       // of the path before the ray
    Vec3 light; // added to the path's estimate at the end, what shadow rays bring included
} PathStep;

// Traces the sample together with the wave of which it was a part in a picture of so many samples,
// fills the first `most` of its steps and result; returns their number.
int integrator_replay(const Tracer *tracer, int x, int y, int sample, PathStep step[], int most,
                      PathResult *result);

// Samples of a pixel that are traced together: those from *begin on that end at 1, 4, 16, 32, 48
// ... or at the planned number. Which rays share a packet may decide what a ray meets that grazes
// an edge, so the numbers alone tell which samples belong together, whatever else is traced.
void integrator_wave(const Tracer *tracer, int sample, int *begin, int *end);

// Where the pass ends that begins at sample `done`: at 1, 4, 16, 32, 64, 128 ..., so that few of
// its samples go in waves that are not full, or at `end`.
int integrator_pass_end(int done, int end);

#endif
