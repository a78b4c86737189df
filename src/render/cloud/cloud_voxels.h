// A cloud whose extinction is that of a file's voxels: its walk through cells, which bound it
// exactly, and lookups by interpolation.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_VOXELS_H
#define RAMIFY_RENDER_CLOUD_CLOUD_VOXELS_H

#include "render/cloud/cloud_grid.h"

// Reads the file of a CLOUD_GRID. Errors carry the cloud's key. Free with cloud_grid_clear, also
// after a failure.
bool cloud_voxels_new(CloudGrid *grid, const Cloud *cloud, const Run *run, Error *e);

int64_t cloud_voxels_bytes(const Cloud *cloud); // that it will take; 0 if the file cannot be read

// Extinction at a place of the scene, 1/m.
float cloud_voxels_extinction(const CloudGrid *grid, Vec3 p);

#endif
