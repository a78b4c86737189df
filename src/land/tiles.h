// A world of land cut into tiles with finer ground, each made alone and all matching exactly. What
// reaches far (rivers, ice, sediment, beds) is in the world's own field, which is coarse and whole;
// what is fine reaches a fixed number of samples, so a tile with a margin of that width knows all
// that its samples depend on.
#ifndef RAMIFY_LAND_TILES_H
#define RAMIFY_LAND_TILES_H

#include "base/run.h"
#include "land/height_field.h"
#include "land/height_maps.h"

typedef struct TileGrid {
    int count; // tiles a side of the world
    int cells; // a side of a tile
    float
        detail; // roughness and gullies finer than the world's samples: 0 = none, 1 = as in nature
    uint64_t seed; // of the roughness
} TileGrid;

// The least and the most; cells and count are powers of two.
enum { TILE_LEAST_CELLS = 16, TILE_MOST_CELLS = 4096, TILE_MOST_COUNT = 4096 };

// Tile (column, row) from the north-west corner, cells + 1 samples a side: neighbours share those
// at their border, with the same bits. Its samples lie on the world's or between them; where both
// have one and detail is 0 they are equal. Beyond the world's border the land is mirrored, or
// repeats if it is periodic. Everything that the world records (wetness, loose ground, ...) is
// interpolated. The caller frees it. ERROR_INPUT for a tile that is not in the world, and for tiles
// coarser than it. The same bits for any number of threads.
HeightField *tile_land(const HeightField *world, const TileGrid *grid, int column, int row,
                       const Run *run, Error *e);

// The same with `margin` more samples on each side; the tile may lie beyond the world's border.
HeightField *tile_land_around(const HeightField *world, const TileGrid *grid, int column, int row,
                              int margin, const Run *run, Error *e);

// A map of the tile, its values in the place of heights. Slope, aspect and curvature are the tile's
// own; those that reach far are the world's, interpolated. The caller frees it. Errors as of
// tile_land and height_map.
HeightField *tile_map(const HeightField *world, const TileGrid *grid, int column, int row,
                      const HeightMap *map, const Run *run, Error *e);

#endif
