// The description of what to render: plain data that scene/ fills and the renderer reads. Metres,
// degrees, Y up, right-handed, linear Rec. 709.
#ifndef RAMIFY_RENDER_WORLD_H
#define RAMIFY_RENDER_WORLD_H

#include "mesh/geometry.h"
#include "render/camera.h"
#include "render/cloud/cloud.h"
#include "render/film_params.h"
#include "render/light/light.h"
#include "render/material/mask.h"
#include "render/material/material.h"
#include "render/medium/medium.h"
#include "render/rain/rain.h"
#include "render/render_params.h"
#include "render/sky/sky.h"

typedef struct World {
    Camera camera;
    FilmParams film;
    RenderParams render;
    Sky sky;
    Medium medium; // MEDIUM_NONE: clear air
    Cloud *cloud;  // owned
    int cloud_count;
    uint64_t cloud_seed;
    Shower *shower; // owned
    int shower_count;
    Light *light; // owned
    int light_count;
    Material *material; // owned
    int material_count;
    Geometry geometry;
    MaskSet masks; // of the layers of materials on the parts; none = no layer lies anywhere
    Views views;   // of all pictures that a renderer makes of it; count 0 = the camera's
} World;

// Defaults: a 40-degree pinhole camera 10 m in front of the origin at eye height, 1280 x 720
// pixels, 64 samples, 8 bounces, an afternoon sun under a clear sky, no geometry.
World world_default(void);

World *world_new(Error *e); // the same on the heap
void world_free(World *world);

// Does any part of the geometry have this material?
bool world_uses_material(const World *world, int material);

#endif
