// Climbers: ivy, wisteria. Stems start at points near another object, cling to its surface and
// spread over it toward attractors there (space colonization on the surface); shoots that find
// nothing to hold hang free. Leaves face away from the surface.
#ifndef RAMIFY_OBJECTS_CLIMBER_CLIMBER_H
#define RAMIFY_OBJECTS_CLIMBER_CLIMBER_H

#include "objects/common/branches.h"
#include "objects/common/organs.h"
#include "objects/common/phenology.h"
#include "objects/common/recipe.h"

typedef struct ClimberStart {
    Vec3 position; // m; moved to the nearest point of the surface
} ClimberStart;

// Shoots that leave the surface.
typedef struct HangingParams {
    int64_t count;    // about
    float length;     // m, of the longest
    float droop;      // 0..1: from stiff shoots to strings
    float clumping;   // 0..1: how much they gather in bulging masses
    float clump_size; // m, from mass to mass
} HangingParams;

// Roots by which stems hold to the surface.
typedef struct RootletParams {
    float spacing; // m between them along a stem of 3 mm radius; 0 = none
    float length;  // m, of the longest
    float radius;  // m, where they leave the stem
} RootletParams;

typedef struct ClimberParams {
    char *species; // NULL: what it names is applied before the file is loaded (scene/species.h)
    char *climbs;  // name of the object that it climbs
    ClimberStart *starts;
    int start_count;
    float height, spread; // m, most above and beside a start
    float spacing;        // m, between the finest stems
    float patchiness;     // 0..1: how much of the area is left out in patches
    float climb;          // tendency upward, 0..
    float wander;         // noise of directions
    float offset;         // m, between the stems' lower sides and the surface
    HangingParams hanging;
    RootletParams rootlets;
    RadiiParams radii;
    float root_radius; // m, at the starts
    LeavesParams leaves;
    OrganGroup *organs;
    int organ_count;
    SkinningParams skin;
    float season;   // month and its fraction, 1..13; 0 = as leaves has it
    float latitude; // degrees
    Phenology phenology;
} ClimberParams;

// Roles of materials.
enum {
    CLIMBER_BARK,
    CLIMBER_TWIG,
    CLIMBER_LEAF,
    CLIMBER_BLOSSOM,
    CLIMBER_FRUIT,
    CLIMBER_CONE,
    CLIMBER_STALK,
    CLIMBER_ANTHER
};

// Streams of the object's seed.
enum {
    STREAM_CLIMBER_ROOTS = 1,
    STREAM_CLIMBER_ATTRACTORS = 2,
    STREAM_CLIMBER_PATCHES = 3,
    STREAM_CLIMBER_GROWTH = 4,
    STREAM_CLIMBER_HANGING = 5,
    STREAM_CLIMBER_LEAVES = 6,
    STREAM_CLIMBER_ORGANS = 7,
    STREAM_CLIMBER_MASSES = 8,
    STREAM_CLIMBER_ROOTLETS = 9
};

ClimberParams climber_params_default(void); // ivy on a wall

// Adds the hanging shoots to a tree that clings to recipe->surface.
bool climber_add_hanging(OutTree *tree, const ClimberParams *params, const Recipe *recipe,
                         Error *e);

// The rootlets of the stems that cling to the surface. hangs: per node, as in Grown.state. The
// caller frees them with curves_free.
CurveSet *climber_rootlets(const ClimberParams *params, const OutTree *tree, const bool *hangs,
                           uint64_t seed, Error *e);

// The recipe (see recipe.h). Grown.state is a list of bool: does the node hang free?
bool climber_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool climber_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e);
bool climber_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table climber_table; // of its parameters

#endif
