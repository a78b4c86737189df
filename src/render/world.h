// The description of what to render: plain data, filled by the scene and the models, read by the
// renderer. Metres, degrees, Y up, right-handed, linear Rec. 709.
#ifndef RAMIFY_RENDER_WORLD_H
#define RAMIFY_RENDER_WORLD_H

#include "base/vec.h"
#include "mesh/geometry.h"
#include "render/material/material.h"
#include "render/medium/medium.h"

typedef struct Camera {
    Vec3 position, target, up;
    float fov;              // degrees, vertical
    float aperture;         // m, diameter of the lens; 0 = pinhole
    float focus_distance;   // m; 0 = the distance to target
    float shift_x, shift_y; // lens shift, in image heights: keeps verticals upright when looking up
} Camera;

typedef enum FilterKind { FILTER_BLACKMAN_HARRIS, FILTER_BOX, FILTER_GAUSSIAN } FilterKind;

typedef struct FilmParams {
    int width, height;
    FilterKind filter;
    float
        filter_radius; // pixels; samples are drawn from the filter, so no sample touches two pixels
    float crop[4];     // x0, y0, x1, y1 in 0..1
} FilmParams;

typedef enum SkyKind { SKY_NONE, SKY_CONSTANT, SKY_SUN_SKY, SKY_ENVIRONMENT, SKY_NIGHT } SkyKind;

typedef struct Sky {
    SkyKind kind;
    Vec3 color;          // SKY_CONSTANT: radiance
    float sun_elevation; // SKY_SUN_SKY: degrees above the horizon
    float sun_azimuth;   // degrees from +Z toward +X
    float sun_size;      // angular diameter, degrees; 0.53 in nature
    float sun_strength;  // factor on the sun alone, 1 = physical
    float turbidity;     // 1 = pure air, 2-3 clear, 6+ hazy
    float ground_albedo; // grey, for light bounced into the sky
    float clouds; // SKY_SUN_SKY: share of the sky under thin clouds, 0..1; seen, but not cast as
                  // light
    float moon;   // SKY_NIGHT: light of the full moon, 0 = none
    float moon_elevation; // degrees above the horizon
    float moon_azimuth;   // degrees from +Z toward +X
    float moon_size;      // angular diameter, degrees
    float stars;          // SKY_NIGHT: factor on their light
    float city_glow;      // SKY_NIGHT: light of towns along the horizon
    const char *file;     // SKY_ENVIRONMENT: latitude-longitude HDR, borrowed
    float rotation;       // of all of it, sun, moon, clouds and stars too: degrees about +Y
    float strength;       // factor on all of it
    bool visible;         // seen by camera rays; if not, the background is black with alpha 0
    float haze_distance; // m over which distant surfaces fade to 1/e into the sky's horizon colour;
                         // 0 = no haze
} Sky;

typedef enum LightKind { LIGHT_QUAD, LIGHT_SPHERE } LightKind;

typedef struct Light {
    LightKind kind;
    Vec3 radiance; // W / (m^2 sr), per channel
    Vec3 center;   // LIGHT_SPHERE
    float radius;
    Vec3 corner, edge_u, edge_v; // LIGHT_QUAD: emits on the side of edge_u x edge_v
} Light;

typedef struct RenderParams {
    int samples;        // per pixel
    int max_depth;      // bounces
    int roulette_depth; // bounces before Russian roulette may end a path; max_depth = never
    uint64_t seed;
    uint64_t noise_seed; // another number, another pattern of noise in the same picture
    float clamp;         // upper bound on a sample's indirect luminance; 0 = none (unbiased)
    float max_noise; // adaptive: a tile stops when its estimated relative error is below this; 0 =
                     // off
    double max_seconds; // 0 = no limit
} RenderParams;

typedef struct World {
    Camera camera;
    FilmParams film;
    RenderParams render;
    Sky sky;
    Medium medium; // MEDIUM_NONE: clear air
    Light *light;  // owned
    int light_count;
    Material *material; // owned
    int material_count;
    Geometry geometry;
} World;

// A 40-degree pinhole camera 10 m in front of the origin at eye height, 1280 x 720 pixels, 64
// samples, 8 bounces, an afternoon sun under a clear sky, nothing to see.
World world_default(void);

World *world_new(Error *e); // the same on the heap
void world_free(World *world);

#endif
