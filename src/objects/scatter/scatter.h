// Scattering: copies of any objects over the land or over the surface of another object.
#ifndef RAMIFY_OBJECTS_SCATTER_SCATTER_H
#define RAMIFY_OBJECTS_SCATTER_SCATTER_H

#include "land/where.h"
#include "objects/common/things.h"

typedef struct ScatteringParams {
    char *on; // name of the object whose surface they stand on; NULL = the land
    int64_t count;
    Vec3 center;       // m: of the disc on the land, or of the ball that cuts the surface
    float inner;       // m: none nearer to the centre
    float radius;      // m: none farther from it; 0 = the whole surface
    int beyond;        // rings of the surface's copies on which copies stand as on itself
    float clumping;    // 0 = even .. 1 = in patches
    float clump_size;  // m, from patch to patch
    float spacing;     // m: least distance between two places; 0 = any
    float scale[2];    // least and largest size, relative to the thing's
    float stretch[2];  // least and largest height, relative to that of its size
    float tilt;        // degrees: most lean, to any side
    float slope[2];    // degrees from level
    float altitude[2]; // m
    float align;       // 0 = upright .. 1 = along the surface's normal
    float sink;        // m below the surface, of a copy of scale 1
    bool in_water;     // in water, not outside of it
    bool afloat;       // with in_water: on its surface, not on its bed
    Things things;
    MapRange *where; // conditions that all hold
    int where_count;
} ScatteringParams;

ScatteringParams scattering_params_default(void);

// Most copies that it may ask for: those on the surface's copies are among them.
int64_t scattering_most(const ScatteringParams *params);

// Number of the surface's copies that are in the rings asked for; surface: NULL = the land.
int scatter_copies(const ScatteringParams *params, const ShapeSurface *surface);

// On the recipe's surface, or else on the land; outside of water or in it. *settled: how many of
// params->count found a place there; as many again stand on each copy of the surface, or fewer if
// it has ground and water of its own. Clear with thing_places_free, also on failure.
bool scatter_places_init(ThingPlaces *places, const ScatteringParams *params, const Recipe *recipe,
                         const Surroundings *around, int64_t *settled, Error *e);

// All copies: see recipe.h. Nothing grows, so grown is not used.
bool scatter_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table scatter_table; // of its parameters

#endif
