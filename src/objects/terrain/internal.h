// Shared by the parts of the terrain. Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_INTERNAL_H
#define RAMIFY_OBJECTS_TERRAIN_INTERNAL_H

#include "objects/terrain/envelope.h"
#include "objects/terrain/terrain.h"

// Streams of the object's seed.
enum {
    STREAM_OUTLETS = 1,
    STREAM_RIVER_GROWTH = 2,
    STREAM_FIELD = 4,
    STREAM_RIVER_POINTS = 12,
    STREAM_BROOK_POINTS = 13,
    STREAM_WARP_X = 21,
    STREAM_WARP_Z = 22,
    STREAM_NOISE = 23,
    STREAM_UPLIFT = 31,
    STREAM_TERRACES = 41,
    STREAM_WINDINGS = 42,
    STREAM_FOREST = 61
};

// Rivers and everything derived from them.
typedef struct Terrain {
    const TerrainParams *params; // borrowed
    uint64_t seed;
    OutTree *rivers;          // heights and radii filled in; owned by the Grown
    float *area;              // m^2, drainage area of each node
    float *uplift;            // factor on gradients at each node
    float gradient;           // of hillslopes at uplift 1
    TroughEnvelope *land;     // heights of valleys and slopes
    TroughEnvelope *distance; // m to the nearest river, in plan
    // The visible rivers on the finished heights, set by terrain_heights; NULL or without nodes if
    // none is wide enough.
    OutTree *water; // steps of at most half a cell; y = the water's level, radius = half width
    TroughEnvelope *shore; // m to the water's edge, negative in the water
    uint8_t *bank;         // of each sample: 1 = in a bed or at its edge
} Terrain;

// uplift.c: fills terrain->uplift, at least 0.02 at each node. Reads the user's picture.
bool terrain_uplift(Terrain *terrain, const Run *run, Error *e);

// areas.c: fills terrain->area: land drains through its nearest node.
bool terrain_areas(Terrain *terrain, const Run *run, Error *e);

// profile.c: one pass over the rivers: areas, then heights for hillslopes of gradient
// uplift * 1, from the outlets up. A river that would run below another's slope is captured by it,
// and river ends on another's slope are dropped: *captures counts both. Nodes are sorted by height.
bool terrain_profile(Terrain *terrain, const Run *run, int64_t *captures, Error *e);

// Half the width of a valley floor with this drainage area, m.
static inline float terrain_valley(const TerrainParams *params, float area)
{
    return params->rivers.valley * sqrtf(area);
}

// The trough of node i's piece of river (to its parent), for hillslopes of `gradient` times uplift.
Trough terrain_trough(const Terrain *terrain, int64_t i, float gradient);

// Reach of beds beyond the water's edge, in cells: the corners of every cell that water touches.
#define TERRAIN_STRAND 2.0f

// How deep the bed of water of half width `half` lies under the water's level, d from its middle:
// a quarter of that width in the middle, a little at its edge and beside it.
static inline float terrain_bed_depth(float half, float d)
{
    float share = d < half ? d / half : 1.0f;
    return half * (0.03f + 0.25f * (1.0f - share * share));
}

// bed.c: lays the rivers that the grid resolves on the finished heights: fills terrain->water,
// ->shore and ->bank and digs the beds.
bool terrain_lay_rivers(Terrain *terrain, HeightField *field, const Run *run, Error *e);

// The widest child of each node of terrain->water, -1 at the ends; the caller frees the array.
int32_t *terrain_main_children(const OutTree *water, Error *e);

// m from a place to the nearest river's water, negative in it; infinite without water.
float terrain_shore(const Terrain *terrain, float x, float z);

// erosion.c: thermal and stream erosion of a field.
bool terrain_erode(HeightField *field, const TerrainErosionParams *params, const Run *run,
                   Error *e);

// water.c, forest.c: parts of the geometry, moved by params->position.
bool terrain_add_water(const Terrain *terrain, const HeightField *field, const Placing *placing,
                       Error *e);
bool terrain_add_forest(const Terrain *terrain, const HeightField *field, const Placing *placing,
                        Error *e);

#endif
