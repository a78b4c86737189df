#include "shape/grid_file.h"

#include "base/plugin.h"
#include "shape/vdb.h"

GridFile *grid_file_new(Error *e)
{
    const VdbGridFiles *vdb = plugin_table(VDB_PLUGIN, VDB_GRID_FILES, sizeof *vdb, e);
    return vdb ? vdb->make(e) : NULL;
}

void grid_file_free(GridFile *grids)
{
    if (grids) {
        grids->vdb->free(grids);
    }
}

int64_t grid_file_count(const GridFile *grids)
{
    return grids->vdb->count(grids);
}

bool grid_file_add_vectors(GridFile *grids, const char *name, Aabb bounds, float voxel,
                           GridVectors vectors, const void *context, const Run *run, Error *e)
{
    return grids->vdb->add_vectors(grids, name, bounds, voxel, vectors, context, run, e);
}

bool grid_file_add_density(GridFile *grids, const char *name, Aabb bounds, float voxel,
                           GridDensity density, const void *context, const Run *run, Error *e)
{
    return grids->vdb->add_density(grids, name, bounds, voxel, density, context, run, e);
}

bool grid_file_move(GridFile *grids, int64_t first, const Transform *motion, Error *e)
{
    return grids->vdb->move(grids, first, motion, e);
}

bool grid_file_write(const GridFile *grids, const char *file, Error *e)
{
    return grids->vdb->write(grids, file, e);
}
