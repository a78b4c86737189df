// OpenVDB is used in three files: vdb_level_set.cpp makes level sets, vdb_read.cpp reads files,
// this one collects and writes grids of any kind. openvdb comes first, because its headers conflict
// with macros of other headers
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>

#include "base/hash.h"
#include "shape/spare_memory.h"
#include "shape/vdb_internal.h"

#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <vector>

extern "C" {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers" // usual in C
#include "base/file_replace.h"
#pragma GCC diagnostic pop
}

using openvdb::Coord;

namespace
{

// Runs f, which returns whether it succeeded, and converts exceptions to an Error.
template <typename F> bool guarded(Error *e, const F &f)
{
    try {
        SpareMemory spare;
        return f();
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory for OpenVDB grids");
    } catch (const std::exception &x) {
        return error_set(e, ERROR_INTERNAL, "OpenVDB failed: %s", x.what());
    } catch (...) {
        return error_set(e, ERROR_INTERNAL, "OpenVDB failed");
    }
}

// Reading parts of a file requires the offset of each grid, which needs a seekable stream. The
// library offers that only for files it opens itself, without reporting their failures.
struct Writer : openvdb::io::Archive {
    std::string bytes(const openvdb::GridPtrVec &grids) const
    {
        std::ostringstream stream(std::ios_base::binary);
        openvdb::io::Archive::write(stream, grids, true, openvdb::MetaMap());
        if (!stream) {
            throw std::bad_alloc();
        }
        return stream.str();
    }
};

// The library gives each file a random UUID; replaced by a hash of the contents.
void name_after_contents(std::string &bytes)
{
    const size_t at = 8 + 3 * 4 + 1, length = 36;
    if (bytes.size() < at + length || bytes[at + 8] != '-' || bytes[at + 23] != '-') {
        throw std::runtime_error("the name of the file is not where it was");
    }
    uint64_t hash[2] = {HASH_START, 0x84222325cbf29ce4u};
    for (size_t i = at + length; i < bytes.size(); i++) {
        hash[i & 1] = hash_byte(hash[i & 1], static_cast<unsigned char>(bytes[i]));
    }
    for (size_t i = 0, digit = 0; i < length; i++) {
        if (bytes[at + i] != '-') {
            bytes[at + i] = "0123456789abcdef"[hash[digit / 16] >> (digit % 16 * 4) & 15];
            digit++;
        }
    }
}

// Sets the value at point p (m); returns false where there is none.
template <typename Grid>
using Sample = std::function<bool(Vec3 p, typename Grid::ValueType *value)>;

// A grid of samples over bounds, of which those with a value are active. Cut short when the run is
// cancelled.
template <typename Grid>
typename Grid::Ptr sample_box(const char *name, Aabb bounds, float voxel, const Run *run,
                              const Sample<Grid> &sample)
{
    typename Grid::Ptr grid = Grid::create();
    auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    transform->postTranslate(openvdb::Vec3d(bounds.low.x, bounds.low.y, bounds.low.z));
    grid->setTransform(transform);
    grid->setName(name);
    const float rounding = 1e-3f; // of sides that are whole voxels
    Vec3 size = vec3_scale(vec3_sub(bounds.high, bounds.low), 1.0f / voxel);
    int nx = static_cast<int>(ceilf(size.x - rounding)) + 1;
    int ny = static_cast<int>(ceilf(size.y - rounding)) + 1;
    int nz = static_cast<int>(ceilf(size.z - rounding)) + 1;
    size_t area = static_cast<size_t>(ny) * static_cast<size_t>(nz);
    std::vector<typename Grid::ValueType> value(area);
    std::vector<char> active(area);
    auto accessor = grid->getAccessor();
    for (int x = 0; x < nx && !run_is_cancelled(run); x++) {
#pragma omp parallel for num_threads(run->threads) schedule(static)
        for (int y = 0; y < ny; y++) {
            for (int z = 0; z < nz; z++) {
                Vec3 p = vec3_madd(bounds.low, voxel, vec3(float(x), float(y), float(z)));
                size_t at = static_cast<size_t>(y) * static_cast<size_t>(nz) + size_t(z);
                active[at] = sample(p, &value[at]);
            }
        }
        for (size_t at = 0; at < area; at++) {
            if (active[at]) {
                accessor.setValueOn(Coord(x, static_cast<int>(at) / nz, static_cast<int>(at) % nz),
                                    value[at]);
            }
        }
    }
    return grid;
}

// The library composes the names of its types once, in streams that pass over a lack of memory: a
// name cut short would make files that nothing reads.
template <typename Grid> bool is_called(const char *name)
{
    openvdb::GridBase::ConstPtr grid = Grid::create(); // asked as the library asks when it writes
    return grid->type() == name && openvdb::GridBase::isRegistered(name);
}

bool types_have_names()
{
    return is_called<openvdb::FloatGrid>("Tree_float_5_4_3") &&
           is_called<openvdb::Vec3SGrid>("Tree_vec3s_5_4_3");
}

GridFile *make(Error *e)
{
    VdbGridFile *made = nullptr;
    guarded(e, [&] {
        openvdb::initialize();
        if (!types_have_names()) {
            throw std::bad_alloc();
        }
        made = new VdbGridFile;
        return true;
    });
    return made;
}

void free_grids(GridFile *grids)
{
    delete static_cast<VdbGridFile *>(grids);
}

int64_t count_grids(const GridFile *grids)
{
    return static_cast<int64_t>(own(grids).grids.size());
}

// cppcheck-suppress passedByValue ; as C calls it
bool add_vectors(GridFile *grids, const char *name, Aabb bounds, float voxel, GridVectors vectors,
                 const void *context, const Run *run, Error *e)
{
    return guarded(e, [&] {
        auto vector_at = [&](Vec3 p, openvdb::Vec3s *value) {
            Vec3 v;
            bool has = vectors(context, p, &v);
            *value = has ? openvdb::Vec3s(v.x, v.y, v.z) : *value;
            return has;
        };
        auto grid = sample_box<openvdb::Vec3SGrid>(name, bounds, voxel, run, vector_at);
        grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
        own(grids).grids.push_back(grid);
        return !run_is_cancelled(run) || run_cancel_error(e);
    });
}

// cppcheck-suppress passedByValue ; as C calls it
bool add_density(GridFile *grids, const char *name, Aabb bounds, float voxel, GridDensity density,
                 const void *context, const Run *run, Error *e)
{
    return guarded(e, [&] {
        auto density_at = [&](Vec3 p, float *value) {
            *value = density(context, p);
            return *value > 0.0f;
        };
        auto grid = sample_box<openvdb::FloatGrid>(name, bounds, voxel, run, density_at);
        grid->setGridClass(openvdb::GRID_FOG_VOLUME);
        own(grids).grids.push_back(grid);
        return !run_is_cancelled(run) || run_cancel_error(e);
    });
}

bool move_grids(GridFile *grids, int64_t first, const Transform *motion, Error *e)
{
    return guarded(e, [&] {
        const float(*m)[4] = motion->m;
        // the library's vectors are rows, multiplied from the left
        const float rows[16] = {m[0][0], m[1][0], m[2][0], 0, m[0][1], m[1][1], m[2][1], 0,
                                m[0][2], m[1][2], m[2][2], 0, 0,       0,       0,       1};
        const openvdb::math::Mat4d turn(rows);
        bool turns = turn != openvdb::math::Mat4d::identity();
        for (auto i = static_cast<size_t>(first); i < own(grids).grids.size(); i++) {
            if (turns) { // a mere translation keeps the map a plain one
                own(grids).grids[i]->transform().postMult(turn);
            }
            own(grids).grids[i]->transform().postTranslate(
                openvdb::Vec3d(m[0][3], m[1][3], m[2][3]));
            auto vectors = openvdb::gridPtrCast<openvdb::Vec3SGrid>(own(grids).grids[i]);
            if (!turns || !vectors) {
                continue;
            }
            for (auto value = vectors->beginValueOn(); value; ++value) {
                openvdb::Vec3s v = *value;
                Vec3 turned = transform_vector(motion, vec3(v.x(), v.y(), v.z()));
                value.setValue(openvdb::Vec3s(turned.x, turned.y, turned.z));
            }
        }
        return true;
    });
}

bool write_grids(const GridFile *grids, const char *file, Error *e)
{
    return guarded(e, [&] {
        std::string bytes = Writer().bytes(own(grids).grids);
        name_after_contents(bytes);
        return file_replace(file, bytes.data(), bytes.size(), e);
    });
}

} // namespace

extern "C" const VdbGridFiles vdb_grid_files = {sizeof(VdbGridFiles), make,        free_grids,
                                                count_grids,          add_vectors, add_density,
                                                move_grids,           write_grids};
