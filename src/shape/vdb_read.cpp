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
        error_key(e, "grid");
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

// ---- sparse volumes ----

// Blocks and what is in them, before there is a SparseVolume.
struct Sparse {
    Coord first;
    int blocks[3];
    std::vector<int32_t> block;
    std::vector<float> value;

    int32_t add(const float *values)
    {
        value.insert(value.end(), values, values + SPARSE_SAMPLES);
        return static_cast<int32_t>(value.size() / SPARSE_SAMPLES) - 1;
    }

    void place(const Coord &origin, int32_t number)
    {
        int at[3];
        for (int i = 0; i < 3; i++) {
            at[i] = (origin[i] - first[i]) / SPARSE_SIDE;
            if (origin[i] < first[i] || at[i] >= blocks[i]) {
                return;
            }
        }
        block[(size_t(at[2]) * size_t(blocks[1]) + size_t(at[1])) * size_t(blocks[0]) +
              size_t(at[0])] = number;
    }
};

// Density of a value: of a level set, what lies inside rises to 1 across its band.
float density_of(float value, float band)
{
    return band > 0.0f ? std::min(std::max(-value / band, 0.0f), 1.0f) : value;
}

void add_leaves(const FloatGrid &grid, float band, Sparse &sparse)
{
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        float values[SPARSE_SAMPLES];
        bool any = false;
        for (openvdb::Index i = 0; i < SPARSE_SAMPLES; i++) {
            values[i] = density_of(leaf->getValue(i), band);
            any = any || values[i] != 0.0f;
        }
        if (any) {
            sparse.place(leaf->origin(), sparse.add(values));
        }
    }
}

// Larger boxes of one value: their blocks share one block's values.
void add_tiles(const FloatGrid &grid, float band, Sparse &sparse)
{
    auto tile = grid.tree().cbeginValueAll();
    tile.setMaxDepth(FloatGrid::TreeType::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        float value = density_of(*tile, band);
        if (!tile.isTileValue() || value == 0.0f || (band <= 0.0f && !tile.isValueOn())) {
            continue;
        }
        CoordBBox box = tile.getBoundingBox();
        Coord last = sparse.first.offsetBy(sparse.blocks[0] * SPARSE_SIDE - 1,
                                           sparse.blocks[1] * SPARSE_SIDE - 1,
                                           sparse.blocks[2] * SPARSE_SIDE - 1);
        box.intersect(CoordBBox(sparse.first, last));
        if (box.empty()) {
            continue;
        }
        float values[SPARSE_SAMPLES];
        std::fill(values, values + SPARSE_SAMPLES, value);
        int32_t number = sparse.add(values);
        for (int x = box.min().x(); x <= box.max().x(); x += SPARSE_SIDE) {
            for (int y = box.min().y(); y <= box.max().y(); y += SPARSE_SIDE) {
                for (int z = box.min().z(); z <= box.max().z(); z += SPARSE_SIDE) {
                    sparse.place(Coord(x, y, z), number);
                }
            }
        }
    }
}

bool frame(const FloatGrid &grid, const CoordBBox &box, Sparse &sparse, Error *e)
{
    if (box.empty()) {
        return error_set(e, ERROR_INPUT,
                         "its grid '%s' is empty; a grid with active voxels is needed",
                         grid.getName().c_str());
    }
    int64_t all = 1;
    for (int i = 0; i < 3; i++) {
        int low = box.min()[i] & ~(SPARSE_SIDE - 1); // also of negative numbers
        int64_t count = (int64_t(box.max()[i]) - low) / SPARSE_SIDE + 1;
        if (count > SPARSE_MOST) {
            return error_set(e, ERROR_INPUT,
                             "its grid '%s' is %lld voxels long; at most %d are possible, so "
                             "resample the grid",
                             grid.getName().c_str(), (long long)count * SPARSE_SIDE,
                             SPARSE_MOST * SPARSE_SIDE);
        }
        sparse.first[i] = low;
        sparse.blocks[i] = static_cast<int>(count);
        all *= count;
    }
    if (all > SPARSE_MOST_ALL) {
        return error_set(e, ERROR_INPUT,
                         "its grid '%s' spans %lld blocks of 8^3 voxels; at most %d are possible, "
                         "so resample the grid",
                         grid.getName().c_str(), (long long)all, SPARSE_MOST_ALL);
    }
    double bytes = double(all) * sizeof(int32_t) +
                   2.0 * double(grid.tree().leafCount()) * SPARSE_SAMPLES * sizeof(float);
    return memory_check(bytes, e, "its grid '%s'", grid.getName().c_str());
}

SparseVolume *sparse_from(const FloatGrid &grid, Error *e)
{
    Sparse sparse;
    if (!frame(grid, grid.evalActiveVoxelBoundingBox(), sparse, e)) {
        return nullptr;
    }
    bool level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
    float band = level_set ? std::max(grid.background(), 1e-30f) : 0.0f;
    sparse.block.assign(
        size_t(sparse.blocks[0]) * size_t(sparse.blocks[1]) * size_t(sparse.blocks[2]), -1);
    add_leaves(grid, band, sparse);
    add_tiles(grid, band, sparse);
    auto kept = static_cast<int32_t>(sparse.value.size() / SPARSE_SAMPLES);
    SparseVolume *volume = sparse_volume_new(sparse.blocks, kept, e);
    Volume frame = {};
    if (volume && !set_map(grid.transform(), sparse.first, 1, &frame)) {
        error_set(e, ERROR_INPUT, "its grid '%s' has a map that is not linear; resample the grid",
                  grid.getName().c_str());
        sparse_volume_free(volume);
        return nullptr;
    }
    if (volume) {
        volume->to_index = frame.to_index;
        std::copy(sparse.block.begin(), sparse.block.end(), volume->block);
        std::copy(sparse.value.begin(), sparse.value.end(), volume->value);
    }
    return volume;
}

SparseVolume *sparse_of(const char *file, const char *name, Error *e)
{
    SparseVolume *volume = nullptr;
    guarded(e, [&] {
        auto base = find_grid(file, name, true, e);
        volume = base ? sparse_from(*openvdb::gridPtrCast<FloatGrid>(base), e) : nullptr;
        return volume != nullptr;
    });
    return volume;
}

// Active voxels lie in about half as many again blocks as they would fill.
int64_t sparse_bytes_of(const char *file, const char *name, Error *e)
{
    int64_t bytes = 0;
    guarded(e, [&] {
        openvdb::initialize();
        openvdb::io::File input(file);
        input.open(false);
        for (auto at = input.beginName(); at != input.endName() && bytes == 0; ++at) {
            auto grid = input.readGridMetadata(at.gridName());
            if (!grid->isType<FloatGrid>() || (name && at.gridName() != name)) {
                continue;
            }
            auto low = grid->metaValue<openvdb::Vec3i>("file_bbox_min");
            auto high = grid->metaValue<openvdb::Vec3i>("file_bbox_max");
            double all = 1, active = double(grid->metaValue<openvdb::Int64>("file_voxel_count"));
            for (int i = 0; i < 3; i++) {
                all *= std::max(0.0, double(high[i]) - double(low[i])) / SPARSE_SIDE + 1;
            }
            double kept = std::min(all, 1.5 * active / SPARSE_SAMPLES);
            bytes = 1 + static_cast<int64_t>(std::min(
                            1e15, all * sizeof(int32_t) + kept * SPARSE_SAMPLES * sizeof(float)));
        }
        return bytes > 0 ||
               error_set(e, ERROR_INPUT, "there is no such grid of floats; see its list of grids");
    });
    return bytes;
}

} // namespace

extern "C" const VdbReaders vdb_readers;
const VdbReaders vdb_readers = {sizeof(VdbReaders), surface_of, volume_of, sparse_of,
                                sparse_bytes_of};
