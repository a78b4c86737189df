#include "shape/level_set.h"

#include "base/memory.h"
#include "base/plugin.h"
#include "shape/vdb.h"

#include <math.h>

static const VdbLevelSets *level_sets(Error *e)
{
    return plugin_table(VDB_PLUGIN, VDB_LEVEL_SETS, sizeof(VdbLevelSets), e);
}

bool level_set_fits(Aabb bounds, LevelSetFrame frame, Error *e)
{
    const double voxel = (double)frame.voxel, least = 1e-30;
    if (!(voxel >= least) || !isfinite(voxel)) {
        return error_set(e, ERROR_INPUT, "a voxel of %g m; it must be at least %g m", voxel, least);
    }
    if (aabb_is_empty(bounds)) {
        return true;
    }
    Vec3 size = vec3_sub(bounds.high, bounds.low);
    const double across[3] = {(double)size.x, (double)size.y, (double)size.z};
    double blocks = 1.0, most = fmax(fmax(across[0], across[1]), across[2]);
    for (int i = 0; i < 3; i++) {
        blocks *= across[i] / voxel / 8.0 + 2.0;
    }
    if (!(most / voxel < 1e9)) {
        return error_set(e, ERROR_INPUT,
                         "details of %g m in a body of %g m; thicker parts or larger voxels are "
                         "needed",
                         voxel, most);
    }
    return memory_check(blocks * VDB_BLOCK_BYTES, e, "details of %g m in a body of %g m", voxel,
                        most);
}

LevelSet *level_set_from_mesh(const Mesh *mesh, LevelSetFrame frame, const Run *run, Error *e)
{
    const VdbLevelSets *vdb = level_set_fits(mesh_bounds(mesh), frame, e) ? level_sets(e) : NULL;
    return vdb ? vdb->from_mesh(mesh, frame, run, e) : NULL;
}

LevelSet *level_set_from_distance(LevelSetDistance distance, const void *shape, Aabb bounds,
                                  LevelSetFrame frame, const Run *run, Error *e)
{
    const VdbLevelSets *vdb = level_set_fits(bounds, frame, e) ? level_sets(e) : NULL;
    return vdb ? vdb->from_distance(distance, shape, bounds, frame, run, e) : NULL;
}

bool level_set_combine(LevelSet *a, LevelSet *b, ShapeOp op, Error *e)
{
    return a->vdb->combine(a, b, op, e);
}

bool level_set_smooth(LevelSet *level_set, int steps, const Run *run, Error *e)
{
    return level_set->vdb->smooth(level_set, steps, run, e);
}

bool level_set_finish(LevelSet *level_set, Error *e)
{
    return level_set->vdb->finish(level_set, e);
}

void level_set_free(LevelSet *level_set)
{
    if (level_set) {
        level_set->vdb->free(level_set);
    }
}

bool level_set_add_to(const LevelSet *level_set, const char *name, GridFile *grids, Error *e)
{
    return level_set->vdb->add_to(level_set, name, grids, e);
}

float level_set_distance(const LevelSet *level_set, Vec3 p)
{
    return level_set->vdb->distance(level_set, p);
}

float level_set_band(const LevelSet *level_set)
{
    return level_set->vdb->band(level_set);
}

Aabb level_set_bounds(const LevelSet *level_set)
{
    return level_set->vdb->bounds(level_set);
}

Mesh *level_set_surface(const LevelSet *level_set, Error *e)
{
    return level_set->vdb->surface(level_set, e);
}
