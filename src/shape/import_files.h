// The files that a mesh's reader may open: the mesh's own and those beside or below it, reading
// alone. A file that names "../../secret" is told that there is none.
#ifndef RAMIFY_SHAPE_IMPORT_FILES_H
#define RAMIFY_SHAPE_IMPORT_FILES_H

#include <assimp/cfileio.h>

// For aiImportFileEx; file is borrowed as long as the result is in use.
struct aiFileIO import_files(const char *file);

#endif
