// Reads grids of OpenVDB files, in a child process (base/child.h): the file is untrusted.
#ifndef RAMIFY_SHAPE_VDB_READ_H
#define RAMIFY_SHAPE_VDB_READ_H

#include "base/child.h"
#include "base/mesh.h"
#include "shape/volume.h"

// The surface of the file's first scalar grid, as triangles: of a level set where it is 0, of a fog
// volume where it is half its largest value. NULL and e otherwise. Runs in the child.
Mesh *vdb_surface(const char *file, Error *e);

// The voxels of the grid with this name (NULL = the first of scalars or vectors), as a dense array
// of at most VOLUME_MOST samples along each axis. Runs in the child.
Volume *vdb_volume(const char *file, const char *name, Error *e);

#endif
