// Proven bounds of a cloud's extinction in the cells of its grid, for tracking.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_BOUNDS_H
#define RAMIFY_RENDER_CLOUD_CLOUD_BOUNDS_H

#include "render/cloud/cloud_grid.h"

// Fills grid->cell and makes grid->part from grid->node.
bool cloud_bounds_fill(CloudGrid *grid, const Run *run, Error *e);

// Finds how far cells without droplets lie from those with some, once the bounds are known.
void cloud_bounds_find_gaps(CloudGrid *grid);

#endif
