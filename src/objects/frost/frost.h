// Frost (Tanaka et al., section 5.3): crystals that grow over a pane or a bubble. Spines follow the
// guide field that leads away from their nucleus, turned by an angle; then sides leave them at 60
// degrees, and sides of sides, until they meet what froze before. Everything is in proportion to
// the surface's own size.
#ifndef RAMIFY_OBJECTS_FROST_FROST_H
#define RAMIFY_OBJECTS_FROST_FROST_H

#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

typedef enum FrostSurface {
    FROST_PANE,  // the rectangle width x height about `position`, facing +Z
    FROST_BUBBLE // the sphere of `radius` about `position`
} FrostSurface;

typedef enum FrostPlace {
    FROST_BORDER,   // nuclei stand along the pane's border
    FROST_SCATTERED // anywhere on it
} FrostPlace;

typedef struct FrostNucleus {
    Vec3 position; // m; taken to the nearest point of the surface
} FrostNucleus;

typedef struct FrostParams {
    FrostSurface surface;
    Vec3 position;       // m
    float width, height; // m, pane
    float radius;        // m, bubble
    int nuclei;          // how many are placed where none are listed; a bubble's first one lies at
                         // its bottom
    FrostPlace place;
    FrostNucleus *nucleus; // listed ones
    int nucleus_count;
    float turn;         // degrees that the field sweeps from a nucleus to the rim
    float field_weight; // of the field against the pull of the free surface
    int64_t spines;     // attractors of the spines: more make them stand closer
    int64_t sides;      // attractors of the sides: more make them finer; 0 = bare spines
    float angle;        // degrees between a side and what it leaves; 60 for ice
    float skip;         // 0..1: probability that a side does not grow
    int orders;         // of branching: 1 = sides alone, 3 = sides of sides of sides
    float width_share;  // half-width of the finest blades, in spacings between sides
    float relief;       // height of a blade's rib over its half-width
    float rime;         // 0..1: share of the sides that are white with air instead of clear
    int64_t grains;     // loose crystals between the blades, mostly near the border
} FrostParams;

enum { FROST_ICE, FROST_RIME }; // roles of materials

// Streams of the object's seed.
enum {
    STREAM_FROST_NUCLEI = 1,
    STREAM_FROST_SPINE_POINTS = 2,
    STREAM_FROST_SPINES = 3,
    STREAM_FROST_SIDE_POINTS = 4,
    STREAM_FROST_SIDES = 5,
    STREAM_FROST_GRAINS = 6
};

// Window frost on a pane of 0.6 x 0.45 m; a bubble has its own numbers.
FrostParams frost_params_default(FrostSurface surface);

// The recipe (see recipe.h). Grows spines and sides; births of a spine's nodes follow one by one,
// those of sides by twos. Radius = half-width of the blades, normal = the surface's, colony = the
// nucleus. No two segments cross: a crystal ends where another was first.
bool frost_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool frost_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                  Error *e);

// The blades as meshes of triangles, clear ones and white ones: closed pieces that overlap where a
// side leaves. The grains are instances, half of them white.
bool frost_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Appends orders (of branching, spines being 0), side_angle and side_angle_spread (degrees, where a
// side leaves), swept (degrees about the nucleus that the longest spines turn on their way, mean
// over those that get at least half as far as the furthest).
bool frost_measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                   Error *e);

extern const struct Table frost_table; // of its parameters

#endif
