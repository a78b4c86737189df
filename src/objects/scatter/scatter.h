// Scattering: copies of any objects over the land or over the surface of another object.
#ifndef RAMIFY_OBJECTS_SCATTER_SCATTER_H
#define RAMIFY_OBJECTS_SCATTER_SCATTER_H

#include "land/where.h"
#include "objects/kind.h"

// One of the objects that are copied.
typedef struct Thing {
    SceneObject object; // without a name; first, for the offsets of the kinds' keys
    float share;        // of the copies, relative to the other things'
} Thing;

typedef struct ScatteringParams {
    char *on; // name of the object whose surface they stand on; NULL = the land
    int64_t count;
    Vec3 center;       // m: of the disc on the land, or of the ball that cuts the surface
    float inner;       // m: none nearer to the centre
    float radius;      // m: none farther from it; 0 = the whole surface
    float clumping;    // 0 = even .. 1 = in patches
    float clump_size;  // m, from patch to patch
    float spacing;     // m: least distance between two places; 0 = any
    float scale[2];    // least and largest size, relative to the thing's
    float slope[2];    // degrees from level
    float altitude[2]; // m
    float align;       // 0 = upright .. 1 = along the surface's normal
    float sink;        // m below the surface, of a copy of scale 1
    bool in_water;     // in water, not outside of it
    bool afloat;       // with in_water: on its surface, not on its bed
    int variants;      // of each thing
    MapRange *where;   // conditions that all hold
    int where_count;
    Thing *things;
    int thing_count;
} ScatteringParams;

// Where the copies stand.
typedef struct ScatterPlaces {
    Transform *place; // of each copy, from a thing at the origin
    int *thing;       // of each copy: which one, thing * variants + variant
    int64_t count;
} ScatterPlaces;

ScatteringParams scattering_params_default(void);

// On the recipe's surface, or else on the land; outside of water or in it. Fewer than params->count
// if there is no room for more. Clear with scatter_places_free, also on failure.
bool scatter_places_init(ScatterPlaces *places, const ScatteringParams *params,
                         const Recipe *recipe, const Surroundings *around, Error *e);
void scatter_places_free(ScatterPlaces *places);

// All copies: see recipe.h. Nothing grows, so grown is not used.
bool scatter_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table scatter_table; // of its parameters

#endif
