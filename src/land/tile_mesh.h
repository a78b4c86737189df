// Land as one mesh of tiles: those near the eye with all their cells, those farther with half of
// them, a quarter, and so on, without cracks. Beyond the world's border the land goes on as tiles.h
// tells, so one mesh reaches from a metre to the horizon.
#ifndef RAMIFY_LAND_TILE_MESH_H
#define RAMIFY_LAND_TILE_MESH_H

#include "base/mesh.h"
#include "land/tile_places.h"
#include "land/tiles.h"

// A sample of a tile, at the place of the world that it shows: beyond the border, the mirrored one.
typedef struct TileSample {
    Vec2 at;     // m, in the world's space
    double u, v; // the same in the world's cells from its corner: whole numbers at its samples
    float cell;  // m, of the tile
} TileSample;

// What shapes tiles beyond what the world tells, such as the beds of rivers narrower than its
// cells.
typedef struct TileShaping {
    // The sample's height, m, from that of the tile. Called by several threads at once.
    float (*height)(const void *data, const TileSample *sample, float height);
    const void *data;
    const uint8_t *whole; // of each tile of the world, row by row: 1 = it is drawn with the world's
                          // own cells at least
} TileShaping;

typedef struct TileView {
    const Vec3 *eye; // in the world's space; NULL = all tiles with the world's own cells, flat
    float cell;      // cells are at most this fraction of the distance to the eye
    int beyond;      // rings of the world around itself
    bool seam;       // the land around the tiles is drawn otherwise: they end at the world's own
                     // samples, or at fewer of them where tiles are coarser
    float curve;     // 1/m: a place lies lower by this times the square of its distance from the
                     // eye in plan; 1 / (2 R) on a ball of radius R
    const TileShaping *shaping; // NULL = none
} TileView;

enum { TILE_LEAST_DRAWN = 2 }; // cells a side of the coarsest tiles

// The cells of tile (column, row), which may lie beyond the border, a side.
int tile_mesh_cells(const HeightField *world, const TileGrid *grid, const TileView *view,
                    int column, int row);

// A place where tiles meet has the height of the coarsest of them, so that their vertices there are
// equal to the bit; every other vertex of a tile of n cells has the height that tile_land gives it
// in a grid of tiles of n cells (of tiles coarser than the world: the world's own height), as it is
// shaped, less the curve. Normals, uv and site as of height_mesh_new. places: filled in for
// tile_places_height, cleared by the caller; NULL = not wanted. Errors as of tile_land. The same
// bits for any number of threads. The caller frees it with mesh_free.
Mesh *tile_mesh_new(const HeightField *world, const TileGrid *grid, const TileView *view,
                    TilePlaces *places, const Run *run, Error *e);

// m by which a place lies lower on the Earth's curve.
float tile_view_sinks(const TileView *view, float x, float z);

#endif
