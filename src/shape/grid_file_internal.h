// What is behind a GridFile, for the two files that know OpenVDB. C++.
#ifndef RAMIFY_SHAPE_GRID_FILE_INTERNAL_H
#define RAMIFY_SHAPE_GRID_FILE_INTERNAL_H

#include <openvdb/openvdb.h>

struct GridFile {
    openvdb::GridPtrVec grids;
};

#endif
