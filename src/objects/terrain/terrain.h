// Terrain (Tanaka et al., section 5.5): rivers as out-trees on a plane, heights from their water,
// ridges where the slopes of two rivers meet, sparse convolution noise for the fine erosion.
// Everything but the last passes is a function of the place, not of a grid: more samples show the
// same land in more detail.
#ifndef RAMIFY_OBJECTS_TERRAIN_TERRAIN_H
#define RAMIFY_OBJECTS_TERRAIN_TERRAIN_H

#include "field/guide_field.h"
#include "land/height_field.h"
#include "objects/common/recipe.h"
#include "outtree/out_tree.h"

// One stroke of the user's brush: the land rises faster along a line. Places are shares of the
// terrain's size, (0, 0) in its middle, so a terrain of any size takes the same strokes.
typedef struct UpliftStroke {
    float from[2], to[2]; // equal: a round spot
    float radius;         // where the stroke has faded to nothing
    float strength;       // added to `base` in the middle of the stroke; negative sinks land
} UpliftStroke;

typedef struct UpliftParams {
    float base;  // 1
    float noise; // 0..1: share by which it wavers from place to place
    UpliftStroke *strokes;
    int stroke_count;
    char *image; // grey picture laid over the terrain, north up: its factor; NULL
} UpliftParams;

typedef enum TerrainSide {
    SIDE_ALL,
    SIDE_NORTH, // -z
    SIDE_EAST,  // +x
    SIDE_SOUTH,
    SIDE_WEST
} TerrainSide;

typedef struct RiverParams {
    int outlets;         // on the border
    TerrainSide side;    // where they are
    int64_t count;       // attractors of the finest level: about as many brooks
    float winding;       // noise of the growth's directions, 0..1
    float gradient;      // of brooks, as a share of the hillslopes' gradient, 0..0.9
    float concavity;     // exponent of the slope-area law; 0.42 in nature
    float valley;        // half width of valley floors, as a share of sqrt(drainage area)
    float water;         // half width of the water, likewise; 0 = no water
    FieldParams *fields; // guide vector fields over the rivers' growth
    int field_count;
    float field_weight;
} RiverParams;

typedef struct TerrainNoiseParams {
    int iterations;   // octaves of sparse convolution noise, eq. (16); 0 = none
    float amplitude;  // height of the first as a share of its wavelength
    float wavelength; // of the first, as a share of the size; 0 = as the brooks are apart
    float gain;       // height of an octave as a share of the last one's
    float ridged;     // 0 = round, 1 = ridges with sharp crests
    float warp;       // how far slopes are pushed about, as a share of the first wavelength
} TerrainNoiseParams;

typedef struct TerrainErosionParams {
    float streams; // 0..1: how deep running water cuts gullies (stream power law)
    float thermal; // 0..1: how far slopes steeper than `talus` fall down
    float talus;   // degrees
} TerrainErosionParams;

typedef struct TerrainTerraceParams {
    int count;      // hard beds between the lowest and the highest point; 0 = none
    float strength; // 0..1: how far the land steps over them
} TerrainTerraceParams;

typedef struct TerrainForestParams {
    int count;       // conifers; 0 = none
    float height;    // m, of the tallest
    float low, high; // altitudes between which they stand, shares of the relief
    float slope;     // degrees: none on steeper land
    float clumping;  // 0 = even, 1 = in woods with clearings
} TerrainForestParams;

typedef struct TerrainParams {
    Vec3 position;     // m: of the middle, at the height of the outlets
    float size;        // m, side of the square
    float relief;      // m from the outlets to the highest point; 0 = natural slopes
    int resolution;    // cells a side
    float water_level; // share of the relief that is under water (a lake or the sea); 0 = none
    UpliftParams uplift;
    RiverParams rivers;
    TerrainNoiseParams noise;
    TerrainErosionParams erosion;
    TerrainTerraceParams terraces;
    TerrainForestParams forest;
    float mesh_error; // largest error of the mesh, as a share of its distance to the camera
} TerrainParams;

TerrainParams terrain_params_default(void); // 12 km of mountains

// The same with what is 0 as it follows from the other parameters. Borrows what params owns.
TerrainParams terrain_params_resolve(const TerrainParams *params);

// The recipe (see recipe.h). Grows the rivers in the plane y = 0, roots at their outlets. Finished,
// y is the height that the land follows, before erosion and terraces, and radii are half the width
// of the water. In the terrain's own space, position not added. The state is all that follows from
// the rivers.
bool terrain_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool terrain_finish(const void *params, const Recipe *recipe, const Grown *whole, Grown *grown,
                    Error *e);

// Heights and wetness from the rivers; square, resolution + 1 samples a side. Every sample off the
// rim drains. Beds of rivers that are wide enough for the grid are dug last. The same bits for any
// number of threads.
HeightField *terrain_heights(const void *params, const Grown *grown, const Run *run, Error *e);

// Height of the lake, in the field's own space.
float terrain_water_height(const TerrainParams *params, const HeightField *field);

enum { TERRAIN_LAND, TERRAIN_WATER, TERRAIN_FOLIAGE }; // roles of materials

// Adds land (finer toward the eye, no cracks; even without one), water and forest.
bool terrain_geometry(const void *params, const Grown *grown, const Placing *placing, Error *e);

extern const struct Table terrain_table; // of its parameters

#endif
