// Land as one mesh of tiles: those near the eye with all their cells, those farther with half of
// them, a quarter, and so on, without cracks. Beyond the world's border the land goes on as tiles.h
// tells, so one mesh reaches from a metre to the horizon.
#ifndef RAMIFY_LAND_TILE_MESH_H
#define RAMIFY_LAND_TILE_MESH_H

#include "base/mesh.h"
#include "land/tiles.h"

typedef struct TileView {
    const Vec3 *eye; // in the world's space; NULL = all tiles with the world's own cells, flat
    float cell;      // cells are at most this fraction of the distance to the eye
    int beyond;      // rings of the world around itself
    float curve;     // 1/m: a place lies lower by this times the square of its distance from the
                     // eye in plan; 1 / (2 R) on a ball of radius R
} TileView;

enum { TILE_LEAST_DRAWN = 2 }; // cells a side of the coarsest tiles

// The cells of tile (column, row), which may lie beyond the border, a side.
int tile_mesh_cells(const HeightField *world, const TileGrid *grid, const TileView *view,
                    int column, int row);

// A place where tiles meet has the height of the coarsest of them, so that their vertices there are
// equal to the bit; every other vertex of a tile of n cells has the height that tile_land gives it
// in a grid of tiles of n cells (of tiles coarser than the world: the world's own height), less the
// curve. Normals, uv and site as of height_mesh_new. Errors as of tile_land. The same bits for any
// number of threads. The caller frees it with mesh_free.
Mesh *tile_mesh_new(const HeightField *world, const TileGrid *grid, const TileView *view,
                    const Run *run, Error *e);

#endif
