// Files of OpenVDB grids: several level sets and vector fields in one .vdb.
#ifndef RAMIFY_SHAPE_GRID_FILE_H
#define RAMIFY_SHAPE_GRID_FILE_H

#include "base/run.h"
#include "base/vec.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct GridFile GridFile; // grids in memory, on their way to a file or from one

GridFile *grid_file_new(Error *e);
void grid_file_free(GridFile *grids); // NULL is fine

int64_t grid_file_count(const GridFile *grids);

// A vector for the point p, m; false = none there. Called from several threads.
typedef bool (*GridVectors)(const void *context, Vec3 p, Vec3 *vector);

// Samples vectors over bounds in voxels of this size, m. Only voxels that have one are active.
// Their type is "contravariant relative": directions in space, that turn and stretch with it.
bool grid_file_add_vectors(GridFile *grids, const char *name, Aabb bounds, float voxel,
                           GridVectors vectors, const void *context, const Run *run, Error *e);

// Turns and moves grids from number first on, and turns their vectors.
bool grid_file_move(GridFile *grids, int64_t first, const Transform *motion, Error *e);

// The same grids give the same bytes. A failure leaves an old file as it was.
bool grid_file_write(const GridFile *grids, const char *file, Error *e);

// All grids of a file. ERROR_INPUT when it cannot be read as one.
GridFile *grid_file_read(const char *file, Error *e);

// Trilinear value at p of the grid of this name, a float or a vector grid; false when there is no
// such grid. For many points of large grids this is slow.
bool grid_file_float_at(const GridFile *grids, const char *name, Vec3 p, float *value);
bool grid_file_vector_at(const GridFile *grids, const char *name, Vec3 p, Vec3 *value);

#ifdef __cplusplus
}
#endif

#endif
