// The nodes of a cloud's grid, from balls or rolls.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_FILL_H
#define RAMIFY_RENDER_CLOUD_CLOUD_FILL_H

#include "render/cloud/cloud_grid.h"

bool cloud_fill(CloudGrid *grid, const Cloud *cloud, uint64_t key, const Run *run, Error *e);

#endif
