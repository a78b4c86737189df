// Materials for OBJ files: Kd, Ks, Ns, d, Ni, Ke and the Pr, Pm of physically based readers.
#ifndef RAMIFY_EXPORT_MTL_H
#define RAMIFY_EXPORT_MTL_H

#include "base/file_writer.h"
#include "export/export.h"

enum { MTL_NAME = 80 };

// The names of all of the world's materials as OBJ and MTL have them: without blanks, each its own.
// The caller frees them.
char (*mtl_names(const World *world, Error *e))[MTL_NAME];

// All materials that the source's parts use, by these names; pictures by their path from the folder
// of `file`. ERROR_IO when a picture is not there.
bool mtl_write(FileWriter *writer, const ExportSource *source, char (*name)[MTL_NAME],
               const char *file, Error *e);

#endif
