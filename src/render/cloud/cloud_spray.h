// The voxels of spray.
#ifndef RAMIFY_RENDER_CLOUD_CLOUD_SPRAY_H
#define RAMIFY_RENDER_CLOUD_CLOUD_SPRAY_H

#include "base/error.h"
#include "mesh/spray.h"
#include "shape/sparse_volume.h"

// Sums the parcels on a grid in the scene, which is as fine as the small ones need and as coarse as
// its size asks for. Each adds its content, whole: the samples' sum times the volume of one is that
// of all contents. Without parcels a grid of zeroes. The caller frees it. ERROR_MEMORY.
SparseVolume *cloud_spray_volume(const SprayParcels *spray, Error *e);

// m between its samples.
float cloud_spray_voxel(const SprayParcels *spray);

#endif
