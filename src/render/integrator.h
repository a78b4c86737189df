// Path tracing: next-event estimation, multiple importance sampling, Russian roulette. Each path is
// a pure function of (tracer, pixel, sample).
#ifndef RAMIFY_RENDER_INTEGRATOR_H
#define RAMIFY_RENDER_INTEGRATOR_H

#include "render/accel/accel.h"
#include "render/camera.h"
#include "render/filter.h"
#include "render/light/lights.h"
#include "render/sampler.h"
#include "render/world.h"

// The data that all paths share; read only.
typedef struct Tracer {
    const World *world;
    const Accel *accel;
    const Lights *lights;
    const MaterialSet *materials;
    Filling outside; // the scene's medium
    Vec3 center;     // of the scene
    float medium_radius;
    bool has_index_matched; // some part is an index-matched interface
    bool has_glow;          // lamps, or parts that glow
    CameraFrame camera;
    Filter filter;
    SamplePlan plan;
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
    float sharpness; // of sky and lights: 1, or less where the lens blurs by more than a pixel
    bool hit;
    Vec3 albedo, normal, position;
    float depth; // m along the ray
    int object;
} PathResult;

// Fills outside, center, medium_radius, has_index_matched and has_glow. bounds: of the scene.
void tracer_set_media(Tracer *tracer, Aabb bounds);

// Traces samples sample .. sample + count - 1 of pixel (x, y) together, count <= WAVE_SIZE.
enum { WAVE_SIZE = 16 };
void integrator_paths(const Tracer *tracer, int x, int y, int sample, int count,
                      PathResult result[]);

#endif
