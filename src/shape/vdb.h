// The plug-in ramify-vdb.so: all that uses OpenVDB, as tables of functions. For the modules of
// shape/ alone that the functions are named after: their headers tell what each does.
#ifndef RAMIFY_SHAPE_VDB_H
#define RAMIFY_SHAPE_VDB_H

#include "shape/grid_file.h"
#include "shape/level_set.h"
#include "shape/sparse_volume.h"
#include "shape/volume.h"

#include <stddef.h>

// See plugin_table.
#define VDB_PLUGIN "vdb"
#define VDB_LEVEL_SETS "vdb_level_sets"
#define VDB_GRID_FILES "vdb_grid_files"
#define VDB_READERS "vdb_readers"

enum { VDB_BLOCK_BYTES = 24 }; // that level_set_from_distance takes per block of 8^3 voxels

typedef struct VdbLevelSets {
    size_t size; // of this struct
    LevelSet *(*from_mesh)(const Mesh *mesh, LevelSetFrame frame, const Run *run, Error *e);
    LevelSet *(*from_distance)(LevelSetDistance distance, const void *shape, Aabb bounds,
                               LevelSetFrame frame, const Run *run, Error *e);
    bool (*combine)(LevelSet *a, LevelSet *b, ShapeOp op, Error *e);
    bool (*smooth)(LevelSet *set, int steps, const Run *run, Error *e);
    bool (*finish)(LevelSet *set, Error *e);
    void (*free)(LevelSet *set);
    bool (*add_to)(const LevelSet *set, const char *name, GridFile *grids, Error *e);
    float (*distance)(const LevelSet *set, Vec3 p);
    float (*band)(const LevelSet *set);
    Aabb (*bounds)(const LevelSet *set);
    Mesh *(*surface)(const LevelSet *set, Error *e);
} VdbLevelSets;

// What the plug-in's own struct begins with.
struct LevelSet {
    const VdbLevelSets *vdb;
};

typedef struct VdbGridFiles {
    size_t size; // of this struct
    GridFile *(*make)(Error *e);
    void (*free)(GridFile *grids);
    int64_t (*count)(const GridFile *grids);
    bool (*add_vectors)(GridFile *grids, const char *name, Aabb bounds, float voxel,
                        GridVectors vectors, const void *context, const Run *run, Error *e);
    bool (*add_density)(GridFile *grids, const char *name, Aabb bounds, float voxel,
                        GridDensity density, const void *context, const Run *run, Error *e);
    bool (*move)(GridFile *grids, int64_t first, const Transform *motion, Error *e);
    bool (*write)(const GridFile *grids, const char *file, Error *e);
} VdbGridFiles;

// What the plug-in's own struct begins with.
struct GridFile {
    const VdbGridFiles *vdb;
};

// All run in a child process (base/child.h), because files are untrusted; the table is fetched
// before the fork.
typedef struct VdbReaders {
    size_t size; // of this struct
    // The surface of the file's first scalar grid, as triangles: of a level set where it is 0, of a
    // fog volume where it is half its largest value.
    Mesh *(*surface)(const char *file, Error *e);
    // The voxels of the grid with this name (NULL = the first of scalars or vectors), as a dense
    // array of at most VOLUME_MOST samples along each axis.
    Volume *(*volume)(const char *file, const char *name, Error *e);
    // See sparse_volume_read and sparse_volume_estimate; values are as in the file.
    SparseVolume *(*sparse)(const char *file, const char *name, Error *e);
    int64_t (*sparse_bytes)(const char *file, const char *name, Error *e);
} VdbReaders;

#endif
