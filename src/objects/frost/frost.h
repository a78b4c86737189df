// Frost (Tanaka et al., section 5.3): crystals that grow over a pane or a bubble. Spines follow the
// guide field away from their nucleus, turned by an angle; sides leave them at 60 degrees, and
// further sides leave those, until they meet earlier crystals. All lengths are in proportion to the
// surface.
#ifndef RAMIFY_OBJECTS_FROST_FROST_H
#define RAMIFY_OBJECTS_FROST_FROST_H

#include "field/guide_field.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

typedef enum FrostSurface {
    FROST_PANE,  // the rectangle width x height about `position`, facing +Z
    FROST_BUBBLE // the sphere of `radius` about `position`
} FrostSurface;

typedef enum FrostHabit {
    FROST_SPINES, // straight needles at 60 degrees
    FROST_FERNS   // plumes: ribs that curve, with barbs and barbules that follow them
} FrostHabit;

typedef enum FrostPlace {
    FROST_BORDER,   // nuclei along the pane's border
    FROST_SCATTERED // anywhere on it
} FrostPlace;

typedef struct FrostNucleus {
    Vec3 position; // m; projected onto the surface
} FrostNucleus;

typedef struct FrostParams {
    FrostSurface surface;
    FrostHabit habit;
    Vec3 position;       // m
    float width, height; // m, pane
    float radius;        // m, bubble
    int nuclei;          // number placed if none are listed; a bubble's first one is at its bottom
    FrostPlace place;
    FrostNucleus *nucleus; // listed ones
    int nucleus_count;
    float turn; // degrees that the field sweeps from a nucleus to the rim
    FieldProfile profile;
    float field_weight; // of the field against the pull of the free surface
    int64_t spines;     // attractors of the spines: more = closer spines
    int64_t sides;      // attractors of the sides: more = finer sides; 0 = bare spines
    float angle;        // degrees between a side and its parent; 60 for ice
    float skip;         // 0..1: probability that a side does not grow
    int orders;         // of branching: 1 = sides alone, 3 = sides of sides of sides
    float curl;         // ferns: degrees by which sides bend toward their parent's direction
    int scratches;      // ferns: lines on a pane from which plumes grow to both sides
    float clear;        // ferns: 0..1: share of the surface that stays clear
    float width_share;  // half-width of the finest blades, in spacings between sides
    float relief;       // height of a blade's rib over its half-width
    float rime;         // 0..1: share of white (air-filled) sides; the others are clear
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
    STREAM_FROST_GRAINS = 6,
    STREAM_FROST_ISLANDS = 7,
    STREAM_FROST_PLUMES = 8,
    STREAM_FROST_SCRATCHES = 9
};

// Window frost on a pane of 0.6 x 0.45 m; a bubble has other defaults.
FrostParams frost_params_default(FrostSurface surface);
FrostParams frost_habit_default(FrostSurface surface, FrostHabit habit);

// The recipe (see recipe.h). Grows spines and sides; births rise by one from node to node of a
// spine, by two along sides. Radius = half-width of the blades, normal = the surface's, colony =
// the nucleus. No two segments cross: a crystal ends where it meets an earlier one.
bool frost_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool frost_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                  Error *e);

// The blades as two triangle meshes, clear and white: closed pieces that overlap where a side
// leaves. The grains are instances, half of them white.
bool frost_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

// Appends orders (of branching, spines being 0), side_angle and side_angle_spread (degrees, between
// a side and its parent), swept (degrees that spines and sides turn about the nucleus, either way,
// mean over nodes at least half as far out as the farthest), spine_swept (degrees that the spines
// alone turn from base to tip; see objects/common/swept.h).
bool frost_measure(const void *params, const Grown *grown, const Recipe *recipe, MeasureList *list,
                   Error *e);

extern const struct Table frost_table; // of its parameters

#endif
