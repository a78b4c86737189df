// Division of the terrain's square into square cells. Private to this folder.
#ifndef RAMIFY_OBJECTS_TERRAIN_CELLS_H
#define RAMIFY_OBJECTS_TERRAIN_CELLS_H

#include "base/vec.h"

#include <stdint.h>

typedef struct TerrainCells {
    int side;          // cells along each
    float size, scale; // of the terrain, m; cells a metre
} TerrainCells;

// At least `wanted` cells, if `most` a side allows; a power of two along each side.
static inline TerrainCells terrain_cells(float size, int64_t wanted, int most)
{
    int side = 1;
    while (side < most && (int64_t)side * side < wanted) {
        side *= 2;
    }
    return (TerrainCells){side, size, (float)side / size};
}

// The column or row of a coordinate, clamped to the border cells.
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
