// Masks: where layers of materials lie on the parts of a world, seen from above.
#ifndef RAMIFY_RENDER_MATERIAL_MASK_H
#define RAMIFY_RENDER_MATERIAL_MASK_H

#include "base/vec.h"

#include <stdint.h>

// Shares 0..255 of 255 at origin + (column * cell.x, row * cell.y) of the plane (x, z), row by row.
typedef struct Mask {
    int columns, rows; // at least 2
    Vec2 cell, origin; // m, in the own space of the part
    uint8_t *share;    // owned
} Mask;

typedef struct MaskSet {
    Mask *mask; // owned
    int64_t count, capacity;
    int32_t *of_part; // owned: the first mask of each part, in the order of its material's layers;
    int64_t part_count; // -1 = the part has none
} MaskSet;

// Frees the masks and empties the set.
void mask_set_clear(MaskSet *set);

// The share 0..1 at a place, by cubic B-splines, so that borders are smooth curves. Beyond the
// samples it is mirrored, as land beyond a terrain's square is.
float mask_at(const Mask *mask, float x, float z);

#endif
