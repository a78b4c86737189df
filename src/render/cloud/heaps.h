// A field of cumulus: many small heaps and few large ones, growing and dissolving, which gather in
// clusters and in streets along the wind.
#ifndef RAMIFY_RENDER_CLOUD_HEAPS_H
#define RAMIFY_RENDER_CLOUD_HEAPS_H

#include "render/cloud/puffs.h"

// Adds the heaps of a square of `period` m from the origin, in which they cover the cloud's share;
// altitudes are absolute.
bool heaps_grow(Puffs *puffs, const Cloud *cloud, float period, uint64_t key, Error *e);

// Width of a heap, in shares of the size of large ones. rank: uniform in [0, 1).
float heaps_width(float rank);

#endif
