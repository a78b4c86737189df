// Finer ground for a window of land: samples between samples, roughness and gullies. Everything
// here reaches a fixed number of samples and counts them from the world's corner, so windows that
// overlap agree bit for bit where both know what is around.
#ifndef RAMIFY_LAND_TILE_DETAIL_H
#define RAMIFY_LAND_TILE_DETAIL_H

#include "base/error.h"
#include "base/run.h"

#include <stdbool.h>
#include <stdint.h>

// Samples of the world's grid at some level, row by row; indices may lie beyond its borders.
typedef struct TileWindow {
    int64_t x, z; // of the first sample
    int columns, rows;
    float *height; // m; the caller frees it
} TileWindow;

typedef struct TileDetail {
    float cell;     // m, of this level
    float strength; // TileGrid.detail
    uint64_t seed;
    int64_t period; // cells of the world at this level
    bool periodic;  // the world repeats instead of being mirrored
} TileDetail;

// Rounded down, of negative numbers too.
static inline int64_t tile_half(int64_t index)
{
    return index >> 1;
}

// What an index along an axis of `cells` cells stands for: beyond them, of the cells mirrored or
// repeated.
static inline int64_t tile_folded(int64_t index, int64_t cells, bool periodic)
{
    int64_t period = periodic ? cells : 2 * cells;
    int64_t i = (index % period + period) % period;
    return i > cells ? period - i : i;
}

// Fills a window of twice the density from one that has the samples around it: odd samples by four
// neighbours (Deslauriers and Dubuc 1989), so even ones keep their values.
bool tile_refine(TileWindow *fine, const TileWindow *coarse, const Run *run, Error *e);

// Samples around a sample that tile_roughen looks at.
int tile_detail_reach(void);

// Roughens slopes and lets short-lived water cut gullies into them.
bool tile_roughen(TileWindow *window, const TileDetail *detail, const Run *run, Error *e);

#endif
