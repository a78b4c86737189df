// Carries the light of one part of the sky through a shade grid.
#ifndef RAMIFY_GROW_LIGHT_SHADE_SWEEP_H
#define RAMIFY_GROW_LIGHT_SHADE_SWEEP_H

#include "grow/light/shade_grid.h"
#include "grow/light/sky_parts.h"

// What the leaves of each cell do to light of one ring: its parts cross a layer of cells along ways
// of equal length.
typedef struct LeafLayer {
    float *passes;  // share of the light that leaves the cell
    float *catches; // mean light on the cell's leaves, share of what enters: leaves of one cell
                    // shade each other
} LeafLayer;

bool leaf_layer_init(LeafLayer *layer, const ShadeGrid *grid, int ring, int threads, Error *e);
void leaf_layer_clear(LeafLayer *layer);

// Adds the light of the part to sum[0], and its direction times it to sum[1..3], cell by cell. In
// each layer, from the side of the sky, the light that enters a cell is interpolated from what left
// the layer before (weights add up to 1, so none is lost or made); outside of the grid it is 1.
bool shade_sweep(const ShadeGrid *grid, const LeafLayer *layer, const SkyPart *part, float *sum[4],
                 Error *e);

#endif
