// A frost flower: a rosette of feathers of ice that stands on thin new ice, where calm, cold air
// over it is full of vapour (Style and Worster, Frost flower formation on sea ice and lake ice,
// 2009). Each feather is one crystal, a rib with barbs on both sides, on which barbules stand, all
// at the angle of ice in one plane, which bends along the rib.
#ifndef RAMIFY_OBJECTS_FROST_FLOWER_FROST_FLOWER_H
#define RAMIFY_OBJECTS_FROST_FLOWER_FROST_FLOWER_H

#include "objects/common/recipe.h"

enum { FLOWER_MOST_ORDERS = 3 };

typedef struct FrostFlowerParams {
    Vec3 position;       // m, of the middle of its foot
    Vec3 rotation;       // degrees, about x, then y, then z
    float size;          // m, its width; feathers are about half as long
    int feathers;        // number
    float spread;        // degrees from upright of the outermost feathers
    float uneven;        // 0..1: 0 = an even rosette, 1 = tufts with gaps, long to one side
    float bend;          // degrees by which feathers bend outward from foot to tip, mean
    float feather_width; // relative to its length
    int barbs;           // on each side of a feather of half the size
    int orders;          // 1 = barbs, 2 = barbules on them, 3 = and theirs
    float angle;         // degrees between a side and what bears it; 60 for ice
    float curl;          // degrees by which sides bend toward the tip of what bears them
    float skip;          // 0..1: probability that a side does not grow
    float width_share;   // half-width of the finest blades, in distances between the finest sides
    float relief;        // height of a blade's rib over its half-width
    float rime;          // 0..1: share of the blades that are white; the others are clear
} FrostFlowerParams;

enum { FROST_FLOWER_ICE, FROST_FLOWER_RIME }; // roles of materials

extern const struct Table frost_flower_table; // of its parameters

FrostFlowerParams frost_flower_params_default(void);

// The recipe (see recipe.h), in its own space: the foot at the origin, up along +Y. A feather is a
// root and its descendants, its colony the number of the feather; births rise with the distance
// along the path. Child 0 of a node continues its chain, 1 and 2 are its sides. Radius = half-width
// of the blades, normal = that of the feather's plane.
bool frost_flower_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool frost_flower_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                         Error *e);

// Blades along all chains: see objects/common/blades.h.
bool frost_flower_geometry(const void *params, const Grown *grown, const Placing *placing,
                           Error *e);

// Appends side_angle (degrees, mean between a side and what bears it),
// orders, sides (number).
bool frost_flower_measure(const void *params, const Grown *grown, const Recipe *recipe,
                          MeasureList *list, Error *e);

#endif
