// Narrow-band level sets (OpenVDB): signed distances on a sparse grid of voxels, for shapes that
// have no closed form. Built on one thread of OpenVDB's, whose order of evaluation would show in
// the last bits otherwise.
#ifndef RAMIFY_SHAPE_LEVEL_SET_H
#define RAMIFY_SHAPE_LEVEL_SET_H

#include "shape/envelope.h"
#include "shape/grid_file.h"

#ifdef __cplusplus
extern "C" {
#endif

// The grid: voxel (i, j, k) has its value at origin + voxel * (i, j, k). Level sets that are to be
// combined share one frame.
typedef struct LevelSetFrame {
    Vec3 origin; // m
    float voxel; // m
} LevelSetFrame;

#define LEVEL_SET_BAND 3.0f           // half width of the narrow band, voxels
#define LEVEL_SET_FILE_VOXEL 1.45e-5f // m: the smallest that OpenVDB's files hold

typedef struct LevelSet LevelSet;

// Signed distance of a shape, m; *bound is set to a number that the true distance's magnitude is
// not below. Called from several threads.
typedef double (*LevelSetDistance)(const void *shape, Vec3 p, double *bound);

// Whether a level set over these bounds can be made at all: ERROR_INPUT for a voxel that is none,
// ERROR_MEMORY when it has more of them than the machine has memory. The makers below ask, too.
bool level_set_fits(Aabb bounds, LevelSetFrame frame, Error *e);

// The inside of a closed triangle mesh, whichever way its faces are turned. Holes larger than a
// voxel let the outside in.
LevelSet *level_set_from_mesh(const Mesh *mesh, LevelSetFrame frame, const Run *run, Error *e);

// A shape given by its distance, as far as it lies within bounds.
LevelSet *level_set_from_distance(LevelSetDistance distance, const void *shape, Aabb bounds,
                                  LevelSetFrame frame, const Run *run, Error *e);

// a = a op b. b is used up and only fit to be freed. Not after level_set_finish(a).
bool level_set_combine(LevelSet *a, LevelSet *b, ShapeOp op, Error *e);

// Rounds the surface off by this many steps of the flow d(phi)/dt = Laplacian(phi), each of a time
// of voxel^2 / 6 (a cylinder of radius r ends with sqrt(r^2 - 2 time)). Not after level_set_finish.
bool level_set_smooth(LevelSet *level_set, int steps, const Run *run, Error *e);

// Makes the table that level_set_distance reads.
bool level_set_finish(LevelSet *level_set, Error *e);

void level_set_free(LevelSet *level_set); // NULL is fine

// Adds a copy to the grids of a file. ERROR_INPUT when its voxels are too small for one.
bool level_set_add_to(const LevelSet *level_set, const char *name, GridFile *grids, Error *e);

// Trilinear; clamped to +- LEVEL_SET_BAND voxels. Safe to call from many threads once finished.
float level_set_distance(const LevelSet *level_set, Vec3 p);

float level_set_band(const LevelSet *level_set); // the clamp, m

// Box of the voxels inside, one voxel wider; empty when there are none. Once finished.
Aabb level_set_bounds(const LevelSet *level_set);

// The zero surface as triangles facing outward with smooth normals; may have no faces. The caller
// frees it with mesh_free.
Mesh *level_set_surface(const LevelSet *level_set, Error *e);

#ifdef __cplusplus
}
#endif

#endif
