// A grid of cubes about a plant. Places beyond its border count to the cells along it.
#ifndef RAMIFY_OBJECTS_COMMON_PLANT_CELLS_H
#define RAMIFY_OBJECTS_COMMON_PLANT_CELLS_H

#include "base/vec.h"

#include <stdint.h>

typedef struct PlantCells {
    Vec3 low;
    float size;   // m, of a cell
    int count[3]; // cells along x, y, z
} PlantCells;

// least: m, of a cell; most: cells along the longest side.
static inline PlantCells plant_cells(Aabb bounds, float least, int most)
{
    Vec3 extent = vec3_sub(bounds.high, bounds.low);
    float size = fmaxf(least, vec3_largest(extent) / (float)most);
    return (PlantCells){.low = bounds.low,
                        .size = size,
                        .count = {1 + (int)(extent.x / size), 1 + (int)(extent.y / size),
                                  1 + (int)(extent.z / size)}};
}

static inline int64_t plant_cells_count(const PlantCells *cells)
{
    return (int64_t)cells->count[0] * cells->count[1] * cells->count[2];
}

// Of the cell at p along an axis.
static inline int plant_cells_along(const PlantCells *cells, Vec3 p, int axis)
{
    float offset = vec3_axis(p, axis) - vec3_axis(cells->low, axis);
    int index = (int)fmaxf(0.0f, offset / cells->size);
    return index < cells->count[axis] ? index : cells->count[axis] - 1;
}

#endif
