// Narrow-band level sets (OpenVDB): signed distances on a sparse voxel grid, for shapes without a
// closed form. Built on a single OpenVDB thread, because its order of evaluation would otherwise
// change the last bits.
#ifndef RAMIFY_SHAPE_LEVEL_SET_H
#define RAMIFY_SHAPE_LEVEL_SET_H

#include "shape/envelope.h"
#include "shape/grid_file.h"

#ifdef __cplusplus
extern "C" {
#endif

// The grid: voxel (i, j, k) has its value at origin + voxel * (i, j, k). Level sets can be combined
// only if they share a frame.
typedef struct LevelSetFrame {
    Vec3 origin; // m
    float voxel; // m
} LevelSetFrame;

#define LEVEL_SET_BAND 3.0f           // half width of the narrow band, voxels
#define LEVEL_SET_FILE_VOXEL 1.45e-5f // m: the smallest voxel an OpenVDB file can hold

typedef struct LevelSet LevelSet;

// Signed distance of a shape, m; *bound is set to a lower bound of the true distance's magnitude.
// Called from several threads.
typedef double (*LevelSetDistance)(const void *shape, Vec3 p, double *bound);

// Checks that a level set over these bounds is possible: ERROR_INPUT for an invalid voxel size,
// ERROR_MEMORY when the voxels would not fit in memory. The constructors below check it too.
bool level_set_fits(Aabb bounds, LevelSetFrame frame, Error *e);

// The inside of a closed triangle mesh of either orientation. Behind holes larger than a voxel the
// inside counts as outside.
LevelSet *level_set_from_mesh(const Mesh *mesh, LevelSetFrame frame, const Run *run, Error *e);

// A shape given by its distance function, clipped to bounds.
LevelSet *level_set_from_distance(LevelSetDistance distance, const void *shape, Aabb bounds,
                                  LevelSetFrame frame, const Run *run, Error *e);

// a = a op b. Consumes b, which can then only be freed. Not allowed after level_set_finish(a).
bool level_set_combine(LevelSet *a, LevelSet *b, ShapeOp op, Error *e);

// Smooths the surface by this many steps of the flow d(phi)/dt = Laplacian(phi), each over a time
// of voxel^2 / 6 (a cylinder of radius r shrinks to sqrt(r^2 - 2 time)). Not allowed after
// level_set_finish.
bool level_set_smooth(LevelSet *level_set, int steps, const Run *run, Error *e);

// Builds the lookup table of level_set_distance.
bool level_set_finish(LevelSet *level_set, Error *e);

void level_set_free(LevelSet *level_set); // NULL is fine

// Adds a copy to the file's grids. ERROR_INPUT when the voxels are too small for the format.
bool level_set_add_to(const LevelSet *level_set, const char *name, GridFile *grids, Error *e);

// Trilinear; clamped to +- LEVEL_SET_BAND voxels. Requires level_set_finish; then thread-safe.
float level_set_distance(const LevelSet *level_set, Vec3 p);

float level_set_band(const LevelSet *level_set); // half width of the band, m

// Bounding box of the inner voxels, one voxel wider; empty when there are none. Requires
// level_set_finish.
Aabb level_set_bounds(const LevelSet *level_set);

// The zero surface as triangles facing outward with smooth normals; possibly without faces. The
// caller frees it with mesh_free.
Mesh *level_set_surface(const LevelSet *level_set, Error *e);

#ifdef __cplusplus
}
#endif

#endif
