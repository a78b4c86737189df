// openvdb comes first, because its headers conflict with macros of other headers
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>

#include "shape/vdb_internal.h"

#include <algorithm>
#include <new>
#include <vector>

extern "C" {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers" // usual in C
#include "base/memory.h"
#pragma GCC diagnostic pop
}

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb::Vec3d;
using openvdb::Vec3SGrid;

namespace
{

const int64_t most_voxels = 200000000; // active ones, of a surface

template <typename F> bool guarded(Error *e, const F &f)
{
    try {
        return f();
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory while reading its grid");
    } catch (const std::exception &x) {
        return error_set(e, ERROR_INPUT, "not readable as OpenVDB: %s; a whole .vdb file is needed",
                         x.what());
    } catch (...) {
        return error_set(e, ERROR_INPUT, "not readable as OpenVDB; a whole .vdb file is needed");
    }
}

bool is_usable(const openvdb::GridBase &grid, bool scalar_only)
{
    return grid.isType<FloatGrid>() || (!scalar_only && grid.isType<Vec3SGrid>());
}

// The named grid, or the first usable one; null and e if there is none.
openvdb::GridBase::Ptr find_grid(const char *file, const char *name, bool scalar_only, Error *e)
{
    openvdb::initialize();
    openvdb::io::File input(file);
    input.open(false); // without delayed loading, which would copy the file to a temporary one
    std::string known;
    for (auto at = input.beginName(); at != input.endName(); ++at) {
        known += (known.empty() ? "" : ", ") + at.gridName();
        if (name && at.gridName() != name) {
            continue;
        }
        auto grid = input.readGrid(at.gridName());
        if (is_usable(*grid, scalar_only)) {
            return grid;
        }
    }
    if (name) {
        error_set(e, ERROR_INPUT, "there is no grid of floats called '%.60s'; the file has: %.200s",
                  name, known.empty() ? "nothing" : known.c_str());
    } else {
        error_set(e, ERROR_INPUT, "there is no grid of floats; the file has: %.200s",
                  known.empty() ? "nothing" : known.c_str());
    }
    return nullptr;
}

float surface_value(const FloatGrid &grid)
{
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
        return 0.0f;
    }
    float highest = 0.0f;
    for (auto value = grid.cbeginValueOn(); value; ++value) {
        highest = std::max(highest, *value);
    }
    return 0.5f * highest;
}

// OpenVDB's faces are clockwise around a level set's inside, where values are low; those of a fog
// volume, where values are high inside, are the other way round.
void add_face(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c, bool reverse)
{
    uint32_t *corner = mesh->index + 3 * mesh->face_count++;
    corner[0] = a;
    corner[1] = reverse ? c : b;
    corner[2] = reverse ? b : c;
}

Mesh *mesh_of(const std::vector<openvdb::Vec3s> &points,
              const std::vector<openvdb::Vec3I> &triangles,
              const std::vector<openvdb::Vec4I> &quads, bool reverse, Error *e)
{
    Mesh *mesh = mesh_new(3, static_cast<int64_t>(points.size()),
                          static_cast<int64_t>(triangles.size() + 2 * quads.size()), 0, e);
    if (!mesh) {
        return nullptr;
    }
    for (size_t i = 0; i < points.size(); i++) {
        mesh->position[i] = vec3(points[i].x(), points[i].y(), points[i].z());
    }
    mesh->face_count = 0;
    for (const auto &t : triangles) {
        add_face(mesh, t[0], t[1], t[2], reverse);
    }
    for (const auto &q : quads) {
        add_face(mesh, q[0], q[1], q[2], reverse);
        add_face(mesh, q[0], q[2], q[3], reverse);
    }
    return mesh;
}

// World to sample numbers; false for a map that is not affine.
bool set_map(const openvdb::math::Transform &transform, const Coord &first, int stride, Volume *v)
{
    if (!transform.isLinear()) {
        return false;
    }
    Vec3d origin = transform.worldToIndex(Vec3d(0, 0, 0));
    for (int axis = 0; axis < 3; axis++) {
        Vec3d unit(0, 0, 0);
        unit[axis] = 1;
        Vec3d column = (transform.worldToIndex(unit) - origin) / stride;
        for (int row = 0; row < 3; row++) {
            v->to_index.m[row][axis] = static_cast<float>(column[row]);
        }
    }
    for (int row = 0; row < 3; row++) {
        v->to_index.m[row][3] = static_cast<float>((origin[row] - first[row]) / stride);
    }
    return true;
}

void put(float value, float *to)
{
    *to = value;
}

void put(const openvdb::Vec3s &value, float *to)
{
    std::copy(value.asPointer(), value.asPointer() + 3, to);
}

template <typename Grid> Volume *sample(const Grid &grid, int components, Error *e)
{
    CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) {
        error_set(e, ERROR_INPUT, "its grid '%s' is empty; a grid with active voxels is needed",
                  grid.getName().c_str());
        return nullptr;
    }
    int64_t longest = 1;
    for (int i = 0; i < 3; i++) {
        longest = std::max(longest, int64_t(box.max()[i]) - box.min()[i] + 1);
    }
    int stride = static_cast<int>((longest + VOLUME_MOST - 1) / VOLUME_MOST), size[3];
    for (int i = 0; i < 3; i++) {
        size[i] = static_cast<int>((int64_t(box.max()[i]) - box.min()[i]) / stride) + 1;
    }
    Volume *volume = volume_new(size, components, e);
    if (!volume) {
        return nullptr;
    }
    if (!set_map(grid.transform(), box.min(), stride, volume)) {
        volume_free(volume);
        error_set(e, ERROR_INPUT, "its grid '%s' has a map that is not linear; resample the grid",
                  grid.getName().c_str());
        return nullptr;
    }
    put(grid.background(), volume->background);
    auto accessor = grid.getConstAccessor();
    float *to = volume->value;
    for (int z = 0; z < size[2]; z++) {
        for (int y = 0; y < size[1]; y++) {
            for (int x = 0; x < size[0]; x++, to += components) {
                put(accessor.getValue(box.min().offsetBy(x * stride, y * stride, z * stride)), to);
            }
        }
    }
    return volume;
}

Mesh *surface_of(const char *file, Error *e)
{
    Mesh *mesh = nullptr;
    guarded(e, [&] {
        auto base = find_grid(file, nullptr, true, e);
        if (!base) {
            return false;
        }
        auto grid = openvdb::gridPtrCast<FloatGrid>(base);
        if (grid->activeVoxelCount() > uint64_t(most_voxels)) {
            return error_set(e, ERROR_INPUT,
                             "its grid '%s' has %lld active voxels; at most %lld "
                             "are possible",
                             grid->getName().c_str(), (long long)grid->activeVoxelCount(),
                             (long long)most_voxels);
        }
        std::vector<openvdb::Vec3s> points;
        std::vector<openvdb::Vec3I> triangles;
        std::vector<openvdb::Vec4I> quads;
        openvdb::tools::volumeToMesh(*grid, points, triangles, quads, surface_value(*grid), 0.0,
                                     false);
        bool level_set = grid->getGridClass() == openvdb::GRID_LEVEL_SET;
        mesh = mesh_of(points, triangles, quads, level_set, e);
        return mesh != nullptr;
    });
    return mesh;
}

Volume *volume_of(const char *file, const char *name, Error *e)
{
    Volume *volume = nullptr;
    guarded(e, [&] {
        auto base = find_grid(file, name, false, e);
        if (!base) {
            return false;
        }
        if (auto scalars = openvdb::gridPtrCast<FloatGrid>(base)) {
            volume = sample(*scalars, 1, e);
        } else if (auto vectors = openvdb::gridPtrCast<Vec3SGrid>(base)) {
            volume = sample(*vectors, 3, e);
        }
        return volume != nullptr;
    });
    return volume;
}

} // namespace

extern "C" const VdbReaders vdb_readers;
const VdbReaders vdb_readers = {sizeof(VdbReaders), surface_of, volume_of};
