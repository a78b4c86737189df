// File access for a mesh's reader: read-only, limited to the mesh file and files beside or below
// it. Any other path, such as "../../secret", is reported as missing.
#ifndef RAMIFY_SHAPE_IMPORT_FILES_H
#define RAMIFY_SHAPE_IMPORT_FILES_H

#include <assimp/cfileio.h>

// For aiImportFileEx; file is borrowed and must outlive the result.
struct aiFileIO import_files(const char *file);

#endif
