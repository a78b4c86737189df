// The state of a path, and what its parts (integrator.c, path_media.c, path_scatter.c) do with it.
// Private to them.
#ifndef RAMIFY_RENDER_PATH_H
#define RAMIFY_RENDER_PATH_H

#include "render/integrator.h"
#include "render/sky/dome.h"

// Sets of random numbers: one for the camera, two for each bounce, and, for each stretch of a ray
// through a medium, three more.
enum {
    SET_CAMERA = 0,
    SET_BSDF = 1,
    SET_LIGHT = 2,
    SETS_PER_BOUNCE = 2,
    SET_MEDIUM = 1 << 20,
    SETS_PER_STRETCH = 3
};

enum { DEEPEST_NESTING = 6 };

// The bodies that a path is in, innermost last, and what fills the innermost.
typedef struct Media {
    Filling now;
    int count;
    int body[DEEPEST_NESTING]; // materials
    bool sheltered;            // in a body that shadow rays do not leave
} Media;

// The state of a path between two surfaces.
typedef struct Path {
    const Tracer *tracer;
    Sampler sampler;
    Ray ray;
    uint32_t key; // of the next ray
    Vec3 throughput;
    Media media;
    Vec3 direct, indirect;
    LightReceiver from; // where the ray's direction was drawn
    Vec3 start;         // where the ray left from there
    float travelled; // m from there to the ray's origin, through films and index-matched interfaces
    float bsdf_pdf;  // of the ray's direction; 0 where light sampling has no part in it
    float spread;    // radians: how fast the footprint grows
    float footprint; // m, at the ray's origin
    int depth;       // bounces so far
    int stretches;   // through media so far
    int crossings;   // of index-matched interfaces
    bool mirrored;   // from the eye by mirrors only
    bool straight;   // from the eye through films only
    int64_t rays;
} Path;

// fmaxf is a call into the library unless NaN may be ignored.
static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

// Adds to what the path brings home.
void path_add_light(Path *path, Vec3 radiance);

// Ends weak paths by chance; false when this one ends.
bool path_survives(Path *path, float u);

// ---- path_media.c

// Through the surface of a body of this material.
void media_cross(Media *media, const Tracer *tracer, int material, bool leaving);

// The medium along a ray that starts amid media. False where there is none.
bool media_line(const Media *media, const Tracer *tracer, const Ray *ray, float far,
                MediumLine *line);

// Turns a ray toward where shadow rays end at the light, and makes it end there.
void path_aim(Ray *ray, const LightSample *light);

// Does light come along the ray, and how much of it? media: where the ray starts.
bool path_lets_through(Path *path, const Ray *ray, const LightSample *light, const Media *media,
                       Vec3 *share);

// ---- path_scatter.c

typedef enum Travel { TRAVEL_ARRIVED, TRAVEL_SCATTERED, TRAVEL_ENDED } Travel;

// Takes the path through the medium around it, up to what its ray meets at `far`.
Travel path_travel(Path *path, float far);

#endif
