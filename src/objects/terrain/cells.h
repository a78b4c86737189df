// The terrain's square in square cells. Private to terrain*.c.
#ifndef RAMIFY_OBJECTS_TERRAIN_CELLS_H
#define RAMIFY_OBJECTS_TERRAIN_CELLS_H

#include "base/vec.h"

#include <stdint.h>

typedef struct TerrainCells {
    int side;          // cells along each
    float size, scale; // of the terrain, m; cells a metre
} TerrainCells;

// A power of two of cells along each side, at most `most`, until there are `wanted` of them.
static inline TerrainCells terrain_cells(float size, int64_t wanted, int most)
{
    int side = 1;
    while (side < most && (int64_t)side * side < wanted) {
        side *= 2;
    }
    return (TerrainCells){side, size, (float)side / size};
}

// The column or row of a coordinate; what lies beyond the border counts to the cells at it.
static inline int terrain_cell(const TerrainCells *cells, float x)
{
    int i = (int)((x + 0.5f * cells->size) * cells->scale);
    return i < 0 ? 0 : i >= cells->side ? cells->side - 1 : i;
}

static inline int64_t terrain_cell_index(const TerrainCells *cells, Vec3 p)
{
    return (int64_t)terrain_cell(cells, p.z) * cells->side + terrain_cell(cells, p.x);
}

#endif
