// The state of a path, shared by integrator.c, path_media.c and path_scatter.c. Private to them.
#ifndef RAMIFY_RENDER_PATH_H
#define RAMIFY_RENDER_PATH_H

#include "render/integrator.h"
#include "render/sky/dome.h"

// Indices of sets of random numbers: one for the camera, two per bounce, and three per stretch of a
// ray through a medium.
enum {
    SET_CAMERA = 0,
    SET_BSDF = 1,
    SET_LIGHT = 2,
    SETS_PER_BOUNCE = 2,
    SET_MEDIUM = 1 << 20,
    SETS_PER_STRETCH = 3
};

enum { DEEPEST_NESTING = 6 };

// The stack of bodies around a path, innermost last, and the medium inside the innermost.
typedef struct Media {
    Filling now;
    int count;
    int body[DEEPEST_NESTING]; // materials
    bool sheltered;            // some body of the stack refracts: shadow rays cannot leave it
} Media;

// A path between two surfaces.
typedef struct Path {
    const Tracer *tracer;
    Sampler sampler;
    Ray ray;
    uint32_t key; // of the next ray
    Vec3 throughput;
    Media media;
    Vec3 direct, indirect;
    LightReceiver from; // the point where the ray's direction was sampled
    Vec3 start;         // the origin of the ray that left it
    float travelled; // m from start to the ray's origin, across films and index-matched interfaces
    float bsdf_pdf;  // of the ray's direction; 0 if light sampling cannot find it
    float spread;    // radians: how fast the footprint grows
    float footprint; // m, at the ray's origin
    float roulette;  // uniform number, drawn with the ray's direction, that decides on arrival
    int depth;       // bounces so far
    int stretches;   // of rays through media so far
    int crossings;   // of index-matched interfaces
    bool mirrored;   // only mirror reflections since the camera
    bool straight;   // only films and index-matched interfaces since the camera
    int64_t rays;
} Path;

// fmaxf compiles to a library call because of NaN.
static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

// Adds throughput x radiance to the estimate.
void path_add_light(Path *path, Vec3 radiance);

// Russian roulette: false if it ends the path; else the throughput is scaled up. Rolled where a ray
// arrives, not where it leaves: a ray that reaches light ends there, so it costs no more.
bool path_survives(Path *path);

// ---- path_media.c

// Pushes a body of this material onto the stack, or removes it when leaving.
void media_cross(Media *media, const Tracer *tracer, int material, bool leaving);

// The density of the medium along a ray that starts inside media. False if there is none.
bool media_line(const Media *media, const Tracer *tracer, const Ray *ray, float far,
                MediumLine *line);

// Redirects a shadow ray from its origin to the end point of the light sample.
void path_aim(Ray *ray, const LightSample *light);

// Transmittance of a shadow ray that starts inside media; false if it is occluded.
bool path_lets_through(Path *path, const Ray *ray, const LightSample *light, const Media *media,
                       Vec3 *share);

// ---- path_scatter.c

typedef enum Travel { TRAVEL_ARRIVED, TRAVEL_SCATTERED, TRAVEL_ENDED } Travel;

// Moves the path through the medium around it, up to the hit at distance `far`.
Travel path_travel(Path *path, float far);

#endif
