// The state of a path, shared by integrator.c and path_*.c. Private to them.
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
    SETS_PER_STRETCH = 3,
    SET_AIR = 1 << 21, // one per bounce
    SET_RAIN = 3 << 20 // two per bounce
};

enum { DEEPEST_NESTING = 6 };

// The stack of bodies around a path, innermost last, and the medium inside the innermost.
typedef struct Media {
    Filling now;
    int count;
    int body[DEEPEST_NESTING]; // materials
    bool sheltered;            // some body of the stack refracts: shadow rays cannot leave it
} Media;

// How clouds lie before the middle of a pixel, for the denoiser: found once for the paths of a
// wave, because it takes a march through the clouds.
typedef struct CloudGuide {
    Vec3 origin, direction;
    bool known;
    Vec3 normal; // where known: see path_clouds.c
} CloudGuide;

// A path between two surfaces.
typedef struct Path {
    const Tracer *tracer;
    PathResult *result;
    struct ShadowQueue *shadows;
    CloudGuide *guide;
    uint64_t cloud_key; // state of the random numbers that track through clouds
    int cloud;          // the number of the one that the path met last
    int64_t rays;
    Sampler sampler;
    uint32_t key; // of the next ray
    Ray ray;
    Vec3 throughput;
    Media media;
    Vec3 direct, indirect;
    LightReceiver from; // the point where the ray's direction was sampled
    Vec3 start;         // the origin of the ray that left it
    float travelled;  // m from start to the ray's origin, across films and index-matched interfaces
    float bsdf_pdf;   // of the ray's direction; 0 if light sampling cannot find it
    float spread;     // radians: how fast the footprint grows
    float footprint;  // m, at the ray's origin
    float roulette;   // uniform number, drawn with the ray's direction, that decides on arrival
    int depth;        // bounces so far
    int stretches;    // of rays through media so far
    int crossings;    // of index-matched interfaces
    int cloud_order;  // how far the phase function of droplets has widened: scatterings by them
    float near;       // chance of a lamp among the lights sampled at start
    float clear;      // expected share of the light from behind that passes what scatters before
                      // it, straight before the camera
    Vec3 veil_normal; // of the clouds there, times what they hide
    bool weighed;     // near lights were weighed by place there
    bool in_cloud;    // scattered by a droplet since the last surface
    bool strayed;     // mirrored back into open water, where no shadow ray follows, since then
    bool lamps_known; // the light of lamps, up to the next surface, has been added
    bool shown;       // that of the lamp or glowing surface that the ray meets has been added
    bool mirrored;    // only mirror reflections since the camera
    bool sharp;       // only reflections since the camera that blur little: air and haze show
    bool guided;      // no chance has decided what a denoiser's guides show
    bool gathers;     // left a point, not of open water, where light was gathered through it
    bool straight;    // only films and index-matched interfaces since the camera
} Path;

// A path where its ray met a surface.
typedef struct Vertex {
    Path *path;
    Hit hit;
    SurfacePoint point;
    Vec3 wo; // against the ray
    Bsdf bsdf;
} Vertex;

// Shadow rays that wait to be traced together. A path casts up to nine while its ray travels: four
// from a medium, two from rain, from the air before it, from the air and from the surface.
enum { CAMERA_GATHERS = 4, SHADOWS_LIMIT = (CAMERA_GATHERS + 5) * WAVE_SIZE };

typedef struct ShadowLight {
    Vec3 light; // what arrives unless the ray is blocked
    Vec3 *sum;  // of a path, that it is added to
} ShadowLight;

typedef struct ShadowQueue {
    int count;
    Ray ray[SHADOWS_LIMIT];
    ShadowLight light[SHADOWS_LIMIT];
} ShadowQueue;

// fmaxf compiles to a library call because of NaN.
static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

// Adds throughput x radiance to the estimate.
void path_add_light(Path *path, Vec3 radiance);

// Queues a shadow ray. light: what arrives at the end of the path unless it is blocked; seen from
// there it is one bounce further than the path.
void path_cast_shadow(Path *path, const Ray *ray, Vec3 light);

// Russian roulette: false if it ends the path; else the throughput is scaled up. Rolled where a ray
// arrives, not where it leaves: a ray that reaches light ends there, so it costs no more.
bool path_survives(Path *path);

// ---- path_media.c

// Pushes a body of this material onto the stack, or removes it when leaving.
void media_cross(Media *media, const Tracer *tracer, int material, bool leaving);

// Share of radiance that leaves open water straight on, at this cosine to the surface. Sky and sun
// then light what is in the water from where they are above it, but with the right irradiance: what
// refraction concentrates is in the factor 1 / ior^2 that radiance loses on its way out.
float open_water_passage(const Material *m, float cosine);

// The density of the medium along a ray that starts inside media. False if there is none.
bool media_line(const Media *media, const Tracer *tracer, const Ray *ray, float far,
                MediumLine *line);

// Redirects a shadow ray from its origin to the end point of the light sample.
void path_aim(Ray *ray, const LightSample *light);

// Dims a share of light by the medium along a ray up to `far`.
void media_dim(const Media *media, const Tracer *tracer, const Ray *ray, float far, Vec3 *share);

// The same as path_cast_shadow for a ray that starts inside media, which dim the light. Where there
// are index-matched interfaces, the ray is traced at once.
void path_cast_shadow_through(Path *path, const Ray *ray, const LightSample *light,
                              const Media *media, Vec3 radiance);

// ---- path_surface.c

typedef enum Arrival { ARRIVAL_SCATTERS, ARRIVAL_CROSSED, ARRIVAL_ENDED } Arrival;

// Fills point, wo and bsdf of the vertex and adds what it emits. ARRIVAL_CROSSED: the ray goes on
// through an index-matched interface.
Arrival path_arrive(Vertex *vertex);

// For a ray straight from the camera that meets a surface behind a medium or clouds: notes albedo
// and normal of all that the ray sees, whether the path gets there or scatters on the way. Else the
// share of a pixel's paths that get there, which is chance, would stand in what guides a denoiser,
// and come back in the picture as specks.
void path_note_behind(Path *path, const Hit *hit);

// Adds the light that comes unscattered from the lamp or glowing surface that the path's ray meets,
// through the medium, clouds, rain and air before it, and notes that it is known. Only for camera
// rays and mirror reflections of them that something may scatter on the way: whether the path gets
// there is chance, and what glows is so much brighter than the scattered light around it that this
// chance would be seen.
void path_show_light(Path *path, const Hit *hit);

// Next-event estimation: samples a light and queues its shadow ray. u: of SET_LIGHT.
void path_sample_light(Vertex *vertex, const float u[4]);

// Samples the BSDF for the next ray. False when the path ends here. u: of SET_BSDF.
bool path_bounce(Vertex *vertex, const float u[4]);

// ---- path_air.c

// Adds the air in front of what the path's ray has met, `distance` m away, and haze that replaces
// all but 1 / e of it after haze_length m (0 = none). Only for camera rays and reflections of
// them that blur little, as those of rippled water: in diffuse light the difference does not show.
void path_see_through_air(Path *path, float distance, float haze_length);

// The share of the light from there that air and haze let through.
Vec3 path_air_clear(const Path *path, float distance, float haze_length);

// ---- path_rain.c

// The share of the light from a place `far` m along a ray that rain before it lets through.
float path_rain_clear(const Tracer *tracer, const Ray *ray, float far);

// Adds the rain in front of what the path's ray has met, `distance` m away. Only for camera rays
// and mirror reflections of them.
void path_see_through_rain(Path *path, float distance);

// ---- path_scatter.c

typedef enum Travel { TRAVEL_ARRIVED, TRAVEL_SCATTERED, TRAVEL_ENDED } Travel;

// Moves the path through the medium around it, up to the hit at distance `far`.
Travel path_travel(Path *path, float far);

// ---- path_clouds.c

// An estimate of the share of light that clouds let pass along a shadow ray of the path.
float path_pass_clouds(Path *path, const Ray *ray);

// The same for what is seen along the path's ray up to `far`, with less spread.
float path_clouds_clear(Path *path, float far);

// Draws the distance at which a droplet scatters the path's ray; INFINITY if none does.
float path_meet_cloud(Path *path, float far);

// Scatters the path there.
Travel path_scatter_in_cloud(Path *path, float t);

// Share of light that clouds let pass along a ray from the camera up to `far`, without wisps.
// *normal: of the clouds, times what they hide.
float path_see_past_clouds(const Path *path, float far, Vec3 *normal);

// Factor on extinctions where the phase function has widened to an even one.
float cloud_even_extinction(const DropletPhase *droplets);

// What leaves a surface that diffuse light has reached meets clouds as diffuse light, too.
void path_leave_diffusely(Path *path);

#endif
