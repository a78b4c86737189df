// openvdb comes first, because its headers conflict with macros of other headers
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/VolumeToMesh.h>

#include "shape/spare_memory.h"
#include "shape/vdb_internal.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <vector>

extern "C" {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers" // usual in C
#include "base/memory.h"
#pragma GCC diagnostic pop
}

using openvdb::Coord;
using openvdb::FloatGrid;
using Leaf = openvdb::FloatTree::LeafNodeType;

static_assert(Leaf::DIM == 8, "distance_at knows the layout of a leaf");

extern "C" const VdbLevelSets vdb_level_sets;

struct VdbLevelSet final : LevelSet {
    LevelSetFrame frame{};
    float band = 0.0f; // m
    // OpenVDB rejects very small voxels. Its lengths are metres times this power of two, which is 1
    // for voxels that are large enough, so that it changes no other bits.
    float unit = 1.0f, metres = 1.0f; // metres: 1 / unit
    FloatGrid::Ptr grid;
    // Lookup table: one entry per block of 8^3 voxels, blocks[0] x blocks[1] x blocks[2] in all,
    // pointing to the block's 512 values.
    Coord first{0, 0, 0}; // voxel at the table's low corner
    int blocks[3] = {0, 0, 0};
    std::vector<const float *> table;
    std::vector<float> inside, outside; // the values of blocks without a leaf

    // cppcheck-suppress uninitDerivedMemberVar ; the braces set it
    VdbLevelSet() : LevelSet{&vdb_level_sets}
    {
    }
    VdbLevelSet(const VdbLevelSet &) = delete;
    VdbLevelSet &operator=(const VdbLevelSet &) = delete;
    ~VdbLevelSet()
    {
        if (grid) {
            clear_without_allocating(*grid);
        }
    }
};

namespace
{

// Runs f, which returns whether it succeeded, and converts exceptions to an Error.
template <typename F> bool guarded(Error *e, const F &f)
{
    try {
        SpareMemory spare;
        return f();
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY,
                         "out of memory while making a level set; "
                         "a larger voxel needs less");
    } catch (const std::exception &x) {
        return error_set(e, ERROR_INTERNAL, "OpenVDB failed: %s", x.what());
    } catch (...) {
        return error_set(e, ERROR_INTERNAL, "OpenVDB failed");
    }
}

// Runs f with this many TBB threads. A single thread gives reproducible results.
template <typename F> auto with_threads(int threads, const F &f)
{
    // TBB prints a warning when asked for more than there are
    tbb::task_arena arena(std::clamp(threads, 1, tbb::info::default_concurrency()));
    return arena.execute(f);
}

std::unique_ptr<VdbLevelSet> make_empty(LevelSetFrame frame)
{
    auto made = std::make_unique<VdbLevelSet>();
    made->frame = frame;
    made->band = LEVEL_SET_BAND * frame.voxel;
    if (frame.voxel < LEVEL_SET_FILE_VOXEL) {
        int exponent;
        frexpf(frame.voxel, &exponent);
        made->unit = ldexpf(1.0f, -exponent);
        made->metres = ldexpf(1.0f, exponent);
    }
    made->grid = FloatGrid::create(made->band * made->unit);
    made->grid->setTransform(
        openvdb::math::Transform::createLinearTransform(frame.voxel * made->unit));
    made->grid->setGridClass(openvdb::GRID_LEVEL_SET);
    return made;
}

// The mesh interface that meshToVolume expects.
struct MeshAdapter {
    const Mesh *mesh;
    LevelSetFrame frame;

    size_t polygonCount() const
    {
        return static_cast<size_t>(mesh->face_count);
    }
    size_t pointCount() const
    {
        return static_cast<size_t>(mesh->vertex_count);
    }
    size_t vertexCount(size_t) const
    {
        return static_cast<size_t>(mesh->face_size);
    }
    void getIndexSpacePoint(size_t n, size_t v, openvdb::Vec3d &out) const
    {
        size_t corner = n * static_cast<size_t>(mesh->face_size) + v;
        Vec3 p = mesh->position[mesh->index[corner]];
        openvdb::Vec3d from(frame.origin.x, frame.origin.y, frame.origin.z);
        out = (openvdb::Vec3d(p.x, p.y, p.z) - from) / static_cast<double>(frame.voxel);
    }
};

// Passed as its base class, for which OpenVDB's library holds the compiled tools.
struct Interrupter final : openvdb::util::NullInterrupter {
    const Run *run;

    explicit Interrupter(const Run *of) : run(of)
    {
    }
    bool wasInterrupted(int) override
    {
        return run_is_cancelled(run);
    }
};

struct Block {
    Coord origin;
    bool inside = false;        // of a block without a leaf
    std::unique_ptr<Leaf> leaf; // where the surface is near
};

static_assert(sizeof(Block) == VDB_BLOCK_BYTES, "level_set_fits counts these bytes");

Vec3 voxel_position(const LevelSetFrame &frame, double i, double j, double k)
{
    double v = static_cast<double>(frame.voxel);
    return vec3(static_cast<float>(static_cast<double>(frame.origin.x) + v * i),
                static_cast<float>(static_cast<double>(frame.origin.y) + v * j),
                static_cast<float>(static_cast<double>(frame.origin.z) + v * k));
}

void fill_block(Block &block, LevelSetDistance distance, const void *shape, const VdbLevelSet &set)
{
    const double reach = static_cast<double>(set.frame.voxel) * 3.5 * 1.7320509; // center to corner
    const Coord &o = block.origin;
    double bound;
    Vec3 center = voxel_position(set.frame, o.x() + 3.5, o.y() + 3.5, o.z() + 3.5);
    block.inside = distance(shape, center, &bound) < 0.0;
    if (bound > reach + static_cast<double>(set.band)) {
        return;
    }
    block.leaf = std::make_unique<Leaf>(o, set.band * set.unit, false);
    for (openvdb::Index n = 0; n < Leaf::SIZE; n++) {
        Coord c = block.leaf->offsetToGlobalCoord(n);
        double d = distance(shape, voxel_position(set.frame, c.x(), c.y(), c.z()), &bound);
        float value = clampf(static_cast<float>(d), -set.band, set.band);
        if (fabsf(value) < set.band) {
            block.leaf->setValueOn(n, value * set.unit);
        } else {
            block.leaf->setValueOff(n, value * set.unit);
        }
    }
}

// All blocks that overlap bounds widened by the narrow band.
std::vector<Block> blocks_of(const Aabb &bounds, const LevelSetFrame &frame)
{
    const float low[3] = {bounds.low.x - frame.origin.x, bounds.low.y - frame.origin.y,
                          bounds.low.z - frame.origin.z};
    const float high[3] = {bounds.high.x - frame.origin.x, bounds.high.y - frame.origin.y,
                           bounds.high.z - frame.origin.z};
    int first[3], last[3];
    if (low[0] > high[0] || low[1] > high[1] || low[2] > high[2]) {
        return {};
    }
    for (int i = 0; i < 3; i++) {
        first[i] = static_cast<int>(floorf((low[i] / frame.voxel - LEVEL_SET_BAND - 1) / 8));
        last[i] = static_cast<int>(floorf((high[i] / frame.voxel + LEVEL_SET_BAND + 1) / 8));
    }
    std::vector<Block> blocks;
    for (int x = first[0]; x <= last[0]; x++) {
        for (int y = first[1]; y <= last[1]; y++) {
            for (int z = first[2]; z <= last[2]; z++) {
                blocks.emplace_back();
                blocks.back().origin = Coord(8 * x, 8 * y, 8 * z);
            }
        }
    }
    return blocks;
}

void make_table(VdbLevelSet &set)
{
    openvdb::CoordBBox box;
    set.inside.assign(Leaf::SIZE, -set.band * set.unit);
    set.outside.assign(Leaf::SIZE, set.band * set.unit);
    if (!set.grid->tree().evalLeafBoundingBox(box)) {
        return;
    }
    set.first = box.min() & ~7;
    for (int i = 0; i < 3; i++) {
        set.blocks[i] = (box.max()[i] - set.first[i]) / 8 + 1;
    }
    set.table.reserve(static_cast<size_t>(set.blocks[0]) * static_cast<size_t>(set.blocks[1]) *
                      static_cast<size_t>(set.blocks[2]));
    FloatGrid::ConstAccessor accessor = set.grid->getConstAccessor();
    for (int x = 0; x < set.blocks[0]; x++) {
        for (int y = 0; y < set.blocks[1]; y++) {
            for (int z = 0; z < set.blocks[2]; z++) {
                Coord c = set.first.offsetBy(8 * x, 8 * y, 8 * z);
                const Leaf *leaf = accessor.probeConstLeaf(c);
                bool inside = !leaf && accessor.getValue(c) < 0.0f;
                set.table.push_back(leaf ? leaf->buffer().data()
                                         : (inside ? set.inside : set.outside).data());
            }
        }
    }
}

const float *block_at(const VdbLevelSet &set, int x, int y, int z)
{
    return set.table[(static_cast<size_t>(x) * static_cast<size_t>(set.blocks[1]) +
                      static_cast<size_t>(y)) *
                         static_cast<size_t>(set.blocks[2]) +
                     static_cast<size_t>(z)];
}

float voxel_at(const VdbLevelSet &set, int x, int y, int z)
{
    const float *block = block_at(set, x >> 3, y >> 3, z >> 3);
    return block[((x & 7) << 6) + ((y & 7) << 3) + (z & 7)];
}

// Values at the eight corners of a cell, z fastest.
void cell_corners(const VdbLevelSet &set, const int c[3], float v[8])
{
    if ((c[0] & 7) < 7 && (c[1] & 7) < 7 && (c[2] & 7) < 7) {
        const float *block = block_at(set, c[0] >> 3, c[1] >> 3, c[2] >> 3);
        const float *at = block + ((c[0] & 7) << 6) + ((c[1] & 7) << 3) + (c[2] & 7);
        v[0] = at[0], v[1] = at[1], v[2] = at[8], v[3] = at[9];
        v[4] = at[64], v[5] = at[65], v[6] = at[72], v[7] = at[73];
        return;
    }
    for (int i = 0; i < 8; i++) {
        v[i] = voxel_at(set, c[0] + (i >> 2), c[1] + (i >> 1 & 1), c[2] + (i & 1));
    }
}

// Extends low..high to the voxels of a block that are inside.
void add_inside(const float *block, const Coord &origin, Coord &low, Coord &high)
{
    for (int i = 0; i < static_cast<int>(Leaf::SIZE); i++) {
        if (block[i] < 0.0f) {
            Coord c = origin.offsetBy(i >> 6, i >> 3 & 7, i & 7);
            low.minComponent(c);
            high.maxComponent(c);
        }
    }
}

void add_triangle(Mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *corner = mesh->index + 3 * mesh->face_count++;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
}

VdbLevelSet &own(LevelSet *set)
{
    return *static_cast<VdbLevelSet *>(set);
}

const VdbLevelSet &own(const LevelSet *set)
{
    return *static_cast<const VdbLevelSet *>(set);
}

LevelSet *from_mesh(const Mesh *mesh, LevelSetFrame frame, const Run *run, Error *e)
{
    std::unique_ptr<VdbLevelSet> made;
    bool done = guarded(e, [&] {
        made = make_empty(frame);
        MeshAdapter adapter{mesh, frame};
        Interrupter interrupter(run);
        with_threads(1, [&] {
            made->grid = openvdb::tools::meshToVolume<FloatGrid>(interrupter.interrupter(), adapter,
                                                                 made->grid->transform(),
                                                                 LEVEL_SET_BAND, LEVEL_SET_BAND);
        });
        return !run_is_cancelled(run) || run_cancel_error(e);
    });
    return done ? made.release() : nullptr;
}

// cppcheck-suppress passedByValue ; as C calls it
LevelSet *from_distance(LevelSetDistance distance, const void *shape, Aabb bounds,
                        LevelSetFrame frame, const Run *run, Error *e)
{
    std::unique_ptr<VdbLevelSet> made;
    bool done = guarded(e, [&] {
        made = make_empty(frame);
        std::vector<Block> blocks = blocks_of(bounds, frame);
        with_threads(run->threads, [&] {
            tbb::parallel_for(size_t(0), blocks.size(), [&](size_t i) {
                if (!run_is_cancelled(run)) {
                    fill_block(blocks[i], distance, shape, *made);
                }
            });
        });
        for (Block &block : blocks) {
            if (block.leaf) {
                made->grid->tree().addLeaf(block.leaf.get()); // may throw
                (void)block.leaf.release();
            } else if (block.inside) {
                made->grid->tree().addTile(1, block.origin, -made->band * made->unit, false);
            }
        }
        return !run_is_cancelled(run) || run_cancel_error(e);
    });
    return done ? made.release() : nullptr;
}

bool combine(LevelSet *one, LevelSet *other, ShapeOp op, Error *e)
{
    VdbLevelSet &a = own(one), &b = own(other);
    return guarded(e, [&] {
        with_threads(1, [&] {
            switch (op) {
            case SHAPE_UNION:
                openvdb::tools::csgUnion(*a.grid, *b.grid);
                break;
            case SHAPE_DIFFERENCE:
                openvdb::tools::csgDifference(*a.grid, *b.grid);
                break;
            case SHAPE_INTERSECTION:
                openvdb::tools::csgIntersection(*a.grid, *b.grid);
                break;
            }
        });
        return true;
    });
}

// Double-buffered: the result does not depend on the number of threads.
bool smooth(LevelSet *level_set, int steps, const Run *run, Error *e)
{
    VdbLevelSet &set = own(level_set);
    return guarded(e, [&] {
        with_threads(run->threads, [&] {
            Interrupter interrupter(run);
            openvdb::tools::LevelSetFilter<FloatGrid> filter(*set.grid, &interrupter.interrupter());
            filter.setSpatialScheme(openvdb::math::FIRST_BIAS); // the other schemes are five times
                                                                // slower
            for (int i = 0; i < steps && !run_is_cancelled(run); i++) {
                filter.laplacian();
            }
        });
        return !run_is_cancelled(run) || run_cancel_error(e);
    });
}

bool finish(LevelSet *level_set, Error *e)
{
    VdbLevelSet &set = own(level_set);
    return guarded(e, [&] {
        with_threads(1, [&] {
            openvdb::tools::pruneLevelSet(set.grid->tree());
            make_table(set);
        });
        return true;
    });
}

void free_set(LevelSet *level_set)
{
    delete static_cast<VdbLevelSet *>(level_set);
}

bool add_to(const LevelSet *level_set, const char *name, GridFile *grids, Error *e)
{
    const VdbLevelSet &set = own(level_set);
    if (set.frame.voxel < LEVEL_SET_FILE_VOXEL) {
        return error_set(
            e, ERROR_INPUT, "grid '%s' has voxels of %g m; OpenVDB's files hold none below %g m",
            name, static_cast<double>(set.frame.voxel), static_cast<double>(LEVEL_SET_FILE_VOXEL));
    }
    return guarded(e, [&] {
        FloatGrid::Ptr copy = set.grid->deepCopy();
        auto transform = openvdb::math::Transform::createLinearTransform(set.frame.voxel);
        transform->postTranslate(
            openvdb::Vec3d(set.frame.origin.x, set.frame.origin.y, set.frame.origin.z));
        copy->setTransform(transform);
        copy->setName(name);
        own(grids).grids.push_back(copy);
        return true;
    });
}

float distance_at(const LevelSet *level_set, Vec3 p)
{
    const VdbLevelSet &set = own(level_set);
    const float x[3] = {p.x - set.frame.origin.x, p.y - set.frame.origin.y,
                        p.z - set.frame.origin.z};
    int c[3];
    float t[3], v[8];
    for (int i = 0; i < 3; i++) {
        float at = x[i] / set.frame.voxel - static_cast<float>(set.first[i]);
        if (!(at >= 0.0f) || !(at < static_cast<float>(8 * set.blocks[i] - 1))) {
            return set.band;
        }
        c[i] = static_cast<int>(at);
        t[i] = at - static_cast<float>(c[i]);
    }
    cell_corners(set, c, v);
    for (int i = 0; i < 4; i++) {
        v[i] = lerpf(v[i], v[i + 4], t[0]);
    }
    return set.metres * lerpf(lerpf(v[0], v[2], t[1]), lerpf(v[1], v[3], t[1]), t[2]);
}

float band_of(const LevelSet *level_set)
{
    const VdbLevelSet &set = own(level_set);
    return set.band;
}

Aabb bounds_of(const LevelSet *level_set)
{
    const VdbLevelSet &set = own(level_set);
    Coord low = Coord::max(), high = Coord::min();
    for (int x = 0; x < set.blocks[0]; x++) {
        for (int y = 0; y < set.blocks[1]; y++) {
            for (int z = 0; z < set.blocks[2]; z++) {
                const float *block = block_at(set, x, y, z);
                if (block != set.outside.data()) {
                    add_inside(block, set.first.offsetBy(8 * x, 8 * y, 8 * z), low, high);
                }
            }
        }
    }
    if (low.x() > high.x()) {
        return aabb_empty();
    }
    low = low - Coord(1);
    high = high + Coord(1);
    return Aabb{voxel_position(set.frame, low.x(), low.y(), low.z()),
                voxel_position(set.frame, high.x(), high.y(), high.z())};
}

Mesh *surface_of(const LevelSet *level_set, Error *e)
{
    const VdbLevelSet &set = own(level_set);
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
    if (!guarded(e, [&] {
            with_threads(1, [&] {
                openvdb::tools::volumeToMesh(*set.grid, points, triangles, quads, 0.0, 0.0, false);
            });
            return true;
        })) {
        return nullptr;
    }
    Mesh *mesh = mesh_new(3, static_cast<int64_t>(points.size()),
                          static_cast<int64_t>(triangles.size() + 2 * quads.size()), 0, e);
    if (!mesh) {
        return nullptr;
    }
    for (size_t i = 0; i < points.size(); i++) {
        Vec3 p = vec3(points[i].x(), points[i].y(), points[i].z());
        mesh->position[i] = vec3_add(set.frame.origin, vec3_scale(p, set.metres));
    }
    mesh->face_count = 0; // OpenVDB's faces are clockwise
    for (const auto &t : triangles) {
        add_triangle(mesh, t[0], t[2], t[1]);
    }
    for (const auto &q : quads) {
        add_triangle(mesh, q[0], q[2], q[1]);
        add_triangle(mesh, q[0], q[3], q[2]);
    }
    if (!mesh_compute_normals(mesh, e)) {
        mesh_free(mesh);
        return nullptr;
    }
    return mesh;
}

} // namespace

extern "C" const VdbLevelSets vdb_level_sets = {
    sizeof(VdbLevelSets), from_mesh, from_distance, combine,   smooth, finish, free_set, add_to,
    distance_at,          band_of,   bounds_of,     surface_of};
