// Definition of a GridFile, for the three files that use OpenVDB. C++.
#ifndef RAMIFY_SHAPE_VDB_INTERNAL_H
#define RAMIFY_SHAPE_VDB_INTERNAL_H

#include <openvdb/openvdb.h>

extern "C" {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers" // usual in C
#include "shape/vdb.h"
#pragma GCC diagnostic pop

extern const VdbGridFiles vdb_grid_files;
}

// OpenVDB's tree destructor allocates, and terminates the program if it cannot. The root's clear()
// does not allocate and leaves the destructor nothing to do.
template <typename Grid> void clear_without_allocating(Grid &grid)
{
    grid.tree().root().clear();
}

struct VdbGridFile final : GridFile {
    openvdb::GridPtrVec grids;

    // cppcheck-suppress uninitDerivedMemberVar ; the braces set it
    VdbGridFile() : GridFile{&vdb_grid_files}
    {
    }
    VdbGridFile(const VdbGridFile &) = delete;
    VdbGridFile &operator=(const VdbGridFile &) = delete;
    ~VdbGridFile()
    {
        for (const auto &base : grids) {
            if (auto scalars = openvdb::gridPtrCast<openvdb::FloatGrid>(base)) {
                clear_without_allocating(*scalars);
            } else if (auto vectors = openvdb::gridPtrCast<openvdb::Vec3SGrid>(base)) {
                clear_without_allocating(*vectors);
            }
        }
    }
};

inline VdbGridFile &own(GridFile *grids)
{
    return *static_cast<VdbGridFile *>(grids);
}

inline const VdbGridFile &own(const GridFile *grids)
{
    return *static_cast<const VdbGridFile *>(grids);
}

#endif
