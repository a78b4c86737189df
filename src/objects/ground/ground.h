// Ground: gently rolling land out to the horizon, with grass near the camera's subject.
#ifndef RAMIFY_OBJECTS_GROUND_GROUND_H
#define RAMIFY_OBJECTS_GROUND_GROUND_H

#include "objects/common/recipe.h"
#include "objects/ground/pond.h"
#include "objects/tree/mix.h"

// Woods in the distance: a few trees, grown once and instanced.
typedef struct GroveParams {
    int count;          // trees; 0 = none
    float inner, outer; // m from the origin: the ring where they stand
    float height;       // m, of the tallest
    float clumping;     // 0 = even .. 1 = in woods with open land between
    int variants;       // different trees
    bool bare;          // without leaves
    float season;       // month, as TreeParams.season; 0 = as the trees have it
    TreeShare *species;
    int species_count;
} GroveParams;

typedef struct GroundParams {
    float radius;        // m, to the horizon
    float relief;        // m, height of the hills
    float wavelength;    // m, from hill to hill
    float flat_radius;   // m about the origin that are flat (height 0), under the subject
    int64_t grass_tufts; // 0 = no grass
    float grass_radius;  // m about grass_center with grass; density falls toward the rim
    Vec3 grass_center;
    float grass_height;    // m, of the tallest blades
    float grass_clumping;  // 0 = even .. 1 = in patches
    int grass_variants;    // different tuft meshes
    int64_t fallen_leaves; // leaves lying about fallen_center; 0 = none
    float fallen_radius;   // m
    Vec3 fallen_center;
    float fallen_gathering; // 0 = evenly over the disc .. 1 = as densely as 1 / distance
    TreeShare *fallen_of;   // whose leaves they are; none = an oak's
    int fallen_of_count;
    GroveParams trees;
    float snow; // m, mean depth of the snow on the land; 0 = none
    Pond *ponds;
    int pond_count;
} GroundParams;

// Roles of materials; bark and foliage are of the distant trees.
enum {
    GROUND_LAND,
    GROUND_FALLEN,
    GROUND_GRASS,
    GROUND_BARK,
    GROUND_FOLIAGE,
    GROUND_SNOW,
    GROUND_WATER,
    GROUND_BED
};

// Streams of the object's seed.
enum {
    STREAM_GROUND_HILLS = 1,
    STREAM_GROUND_BUMPS = 2,
    STREAM_GROUND_PATCHES = 3,
    STREAM_GROUND_GRASS = 4,
    STREAM_GROUND_LEAVES = 5,
    STREAM_GROUND_TREES = 6,
    STREAM_GROUND_WOODS = 7,
    STREAM_GROUND_DRIFTS = 8,
    STREAM_GROUND_PONDS = 9,
    STREAM_GROUND_LITTER = 10
};

GroundParams ground_params_default(void); // 2 km of meadow, 60,000 tufts

// Height of the land at (x, z), m, with its ponds.
float ground_height(const GroundParams *params, uint64_t seed, float x, float z);

// Pond number index in this land.
PondSite ground_pond(const GroundParams *params, uint64_t seed, int index);

// Is the place in a pond?
bool ground_in_pond(const GroundParams *params, uint64_t seed, float x, float z);

// Widths (m) of the border in which the mesh of the land gives way to a pond's own.
PondMargin ground_pond_margin(const Pond *pond);

// The land with grass, leaves and trees: see recipe.h. Nothing grows, so grown is not used.
bool ground_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table ground_table; // of its parameters

#endif
