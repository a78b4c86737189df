// The land as it is drawn, which its water and its trees meet. Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_DRAWN_H
#define RAMIFY_OBJECTS_TERRAIN_DRAWN_H

#include "land/tile_mesh.h"
#include "objects/terrain/internal.h"

typedef struct DrawnLand {
    const Terrain *terrain;
    const HeightField *field; // the terrain's own
    // Of land drawn of tiles, in the terrain's own space, its position not added; NULL = of all
    // samples of the field.
    const Mesh *mesh;
    const TilePlaces *places;
    const TileView *view;
    int column, row; // of the square's copy that is meant; 0, 0 = itself
} DrawnLand;

// Is a copy of the square meant, not itself?
bool drawn_is_copy(const DrawnLand *land);

// Is the land that is meant of tiles? Else it is the square's own mesh, or coarser copies of that.
bool drawn_of_tiles(const DrawnLand *land);

// m from the eye to a place of the square, or of its copy, in the terrain's own space; 0 if the
// land is drawn alike near and far.
float drawn_away(const DrawnLand *land, Vec3 place);

// The height of the land that is drawn at a place of the square, or of its copy; on a flat Earth.
float drawn_land_at(const DrawnLand *land, float x, float z);

// The place in the scene of one that is in the scene as if the Earth was flat, and of the square.
Vec3 drawn_in_scene(const DrawnLand *land, Vec3 place);

// Moves a mesh likewise, to the copy and onto the Earth's curve; uv become its places in plan.
bool drawn_move(const DrawnLand *land, Mesh *mesh, Error *e);

// Adds a mesh of water that is in the scene as if the Earth was flat, and of the square. Takes
// ownership; NULL fails.
bool drawn_add_water(const DrawnLand *land, Mesh *mesh, const Placing *placing, Error *e);

// water.c, flow_water.c, lake_water.c, falls.c, forest.c: parts of the geometry.
bool terrain_add_water(const DrawnLand *land, const Placing *placing, Error *e);
// Of water whose levels the heights record.
bool terrain_add_flow(const Terrain *terrain, const HeightField *field, const Placing *placing,
                      Error *e);
// A level surface for each lake that meets the land.
bool terrain_add_lakes(const DrawnLand *land, const Placing *placing, Error *e);
// The water that falls, a part for each fall; in copies the coarser the farther it is, and without
// spray and white water for clouds. After terrain_lay_rivers.
bool terrain_add_falls(const DrawnLand *land, const Placing *placing, Error *e);
bool terrain_add_forest(const DrawnLand *land, const Placing *placing, Error *e);

// tile_water.c: tiles with beds of rivers and shores of lakes as the terrain has them.
typedef struct TileWater {
    const Terrain *terrain;
    const HeightField *field;
    uint8_t *whole; // owned
    TileShaping shaping;
} TileWater;

// False: ERROR_MEMORY. tile_water_clear afterwards in any case.
bool tile_water_init(TileWater *water, const Terrain *terrain, const HeightField *field, int tiles,
                     Error *e);
void tile_water_clear(TileWater *water);

#endif
