// Definition of GridFile, for the three files that use OpenVDB. C++.
#ifndef RAMIFY_SHAPE_GRID_FILE_INTERNAL_H
#define RAMIFY_SHAPE_GRID_FILE_INTERNAL_H

#include <openvdb/openvdb.h>

// OpenVDB's tree destructor allocates, and terminates the program if it cannot. The root's clear()
// does not allocate and leaves the destructor nothing to do.
template <typename Grid> void clear_without_allocating(Grid &grid)
{
    grid.tree().root().clear();
}

struct GridFile {
    openvdb::GridPtrVec grids;

    GridFile() = default;
    GridFile(const GridFile &) = delete;
    GridFile &operator=(const GridFile &) = delete;
    ~GridFile()
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

#endif
