#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <vector>

extern "C" {
#include "mesh/limit_patch.h"
}

namespace Far = OpenSubdiv::Far;

namespace
{

// A LimitPoint in the form that OpenSubdiv interpolates: weighted sums of all members except the
// normal.
struct Sample {
    Vec3 position;
    Vec2 uv;
    float radius, birth;

    void Clear()
    {
        *this = Sample{};
    }
    void AddWithWeight(const Sample &s, float w)
    {
        position = vec3_madd(position, w, s.position);
        uv.x += w * s.uv.x;
        uv.y += w * s.uv.y;
        radius += w * s.radius;
        birth += w * s.birth;
    }
};

struct Tangent {
    Vec3 v;

    void Clear()
    {
        v = Vec3{0, 0, 0};
    }
    void AddWithWeight(const Sample &s, float w)
    {
        v = vec3_madd(v, w, s.position);
    }
};

std::unique_ptr<Far::TopologyRefiner> make_refiner(const LimitPatch &patch, int level)
{
    std::vector<int> corners(static_cast<size_t>(patch.face_count), 4);
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = patch.vertex_count;
    descriptor.numFaces = patch.face_count;
    descriptor.numVertsPerFace = corners.data();
    descriptor.vertIndicesPerFace = patch.index;

    OpenSubdiv::Sdc::Options options;
    options.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Factory::Options scheme(OpenSubdiv::Sdc::SCHEME_CATMARK, options);
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, scheme));
    if (refiner) {
        Far::TopologyRefiner::UniformOptions uniform(level);
        uniform.fullTopologyInLastLevel = true;
        refiner->RefineUniform(uniform);
    }
    return refiner;
}

// Samples of the last level, refined level by level from the cage.
std::vector<Sample> refine_samples(const LimitPatch &patch, const Far::TopologyRefiner &refiner)
{
    Far::PrimvarRefiner interpolator(refiner);
    std::vector<Sample> coarse(static_cast<size_t>(patch.vertex_count));
    for (size_t i = 0; i < coarse.size(); i++) {
        const LimitPoint &p = patch.vertex[i];
        coarse[i] = Sample{p.position, p.uv, p.radius, p.birth};
    }
    for (int level = 1; level <= refiner.GetMaxLevel(); level++) {
        std::vector<Sample> fine(static_cast<size_t>(refiner.GetLevel(level).GetNumVertices()));
        interpolator.Interpolate(level, coarse.data(), fine);
        coarse.swap(fine);
    }
    return coarse;
}

// Writes the points of one cage face by descending into its four children at each level: child k of
// a quad keeps the order of corners, so it covers the quarter at corner k.
struct GridWriter {
    const Far::TopologyRefiner &refiner;
    const std::vector<LimitPoint> &limit;
    LimitPoint *grid; // of the current face
    int side;         // points along one side of the grid

    void write(int level, int face, int x, int y, int size)
    {
        const Far::TopologyLevel &here = refiner.GetLevel(level);
        if (level < refiner.GetMaxLevel()) {
            const Far::ConstIndexArray child = here.GetFaceChildFaces(face);
            int half = size / 2;
            write(level + 1, child[0], x, y, half);
            write(level + 1, child[1], x + half, y, half);
            write(level + 1, child[2], x + half, y + half, half);
            write(level + 1, child[3], x, y + half, half);
            return;
        }
        const Far::ConstIndexArray corner = here.GetFaceVertices(face);
        put(x, y, corner[0]);
        put(x + 1, y, corner[1]);
        put(x + 1, y + 1, corner[2]);
        put(x, y + 1, corner[3]);
    }
    void put(int x, int y, int vertex)
    {
        grid[y * side + x] = limit[static_cast<size_t>(vertex)];
    }
};

bool evaluate(const LimitPatch &patch, int level, LimitPoint *grid, Error *e)
{
    std::unique_ptr<Far::TopologyRefiner> refiner = make_refiner(patch, level);
    if (!refiner) {
        return error_set(e, ERROR_INTERNAL, "OpenSubdiv refused a patch of %d faces",
                         patch.face_count);
    }
    std::vector<Sample> sample = refine_samples(patch, *refiner);
    std::vector<Sample> at_limit(sample.size());
    std::vector<Tangent> along(sample.size()), across(sample.size());
    Far::PrimvarRefiner(*refiner).Limit(sample.data(), at_limit, along, across);

    std::vector<LimitPoint> limit(sample.size());
    for (size_t i = 0; i < limit.size(); i++) {
        const Sample &s = at_limit[i];
        Vec3 normal = vec3_normalize(vec3_cross(along[i].v, across[i].v));
        limit[i] = LimitPoint{s.position, normal, s.uv, s.radius, s.birth};
    }
    int size = 1 << level;
    GridWriter writer{*refiner, limit, grid, size + 1};
    for (int face = 0; face < patch.wanted_count; face++) {
        writer.write(0, face, 0, 0, size);
        writer.grid += (size + 1) * (size + 1);
    }
    return true;
}

} // namespace

extern "C" bool limit_patch_evaluate(const LimitPatch *patch, int level, LimitPoint *grid, Error *e)
{
    try {
        return evaluate(*patch, level, grid, e);
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory while smoothing a patch of %d faces",
                         patch->face_count);
    } catch (const std::exception &problem) {
        return error_set(e, ERROR_INTERNAL, "OpenSubdiv failed: %s", problem.what());
    } catch (...) {
        return error_set(e, ERROR_INTERNAL, "OpenSubdiv failed");
    }
}
