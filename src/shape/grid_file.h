// OpenVDB files (.vdb) with several level sets and vector fields.
#ifndef RAMIFY_SHAPE_GRID_FILE_H
#define RAMIFY_SHAPE_GRID_FILE_H

#include "base/run.h"
#include "base/vec.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct GridFile GridFile; // grids in memory, to be written

GridFile *grid_file_new(Error *e);
void grid_file_free(GridFile *grids); // NULL is fine

int64_t grid_file_count(const GridFile *grids);

// Sets the vector at point p (m); returns false where there is none. Called from several threads.
typedef bool (*GridVectors)(const void *context, Vec3 p, Vec3 *vector);

// Samples vectors over bounds at this voxel size, m. Only voxels with a vector are active. Their
// type is "contravariant relative": directions that rotate and stretch with space.
bool grid_file_add_vectors(GridFile *grids, const char *name, Aabb bounds, float voxel,
                           GridVectors vectors, const void *context, const Run *run, Error *e);

// Density at point p (m), >= 0. Called from several threads.
typedef float (*GridDensity)(const void *context, Vec3 p);

// Samples a density over bounds at this voxel size, m: a fog volume. Only voxels with some are
// active.
bool grid_file_add_density(GridFile *grids, const char *name, Aabb bounds, float voxel,
                           GridDensity density, const void *context, const Run *run, Error *e);

// Transforms the grids from number first on, rotating their vectors.
bool grid_file_move(GridFile *grids, int64_t first, const Transform *motion, Error *e);

// Writes the grids; equal grids give equal bytes. On failure an existing file stays unchanged.
bool grid_file_write(const GridFile *grids, const char *file, Error *e);

#ifdef __cplusplus
}
#endif

#endif
