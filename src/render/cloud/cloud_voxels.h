// A cloud whose extinction is that of voxels, from a file or of spray: its walk through cells,
// which bound it exactly, and lookups by interpolation.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_VOXELS_H
#define RAMIFY_RENDER_CLOUD_CLOUD_VOXELS_H

#include "render/cloud/cloud_grid.h"

// Is its form voxels instead of nodes?
static inline bool cloud_has_voxels(const Cloud *cloud)
{
    return cloud->kind == CLOUD_GRID || cloud->kind == CLOUD_SPRAY;
}

// Reads the file of a CLOUD_GRID, or sums the parcels of a CLOUD_SPRAY. Errors carry the cloud's
// key. Free with cloud_grid_clear, also after a failure.
bool cloud_voxels_new(CloudGrid *grid, const Cloud *cloud, const Run *run, Error *e);

int64_t cloud_voxels_bytes(const Cloud *cloud); // that it will take; 0 if the file cannot be read

// Extinction at a place of the scene, 1/m.
float cloud_voxels_extinction(const CloudGrid *grid, Vec3 p);

#endif
