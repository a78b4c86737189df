// Materials for OBJ files: Kd, Ks, Ns, d, Ni, Ke and the Pr, Pm of physically based readers.
#ifndef RAMIFY_EXPORT_MTL_H
#define RAMIFY_EXPORT_MTL_H

#include "base/file_writer.h"
#include "export/export.h"

enum { MTL_NAME = 80 };

// Names of all of the world's materials for OBJ and MTL: unique and without blanks. The caller
// frees them.
char (*mtl_names(const World *world, Error *e))[MTL_NAME];

// Writes all materials that parts use under these names; pictures by their path from the folder of
// `file`. ERROR_IO if a picture is missing.
bool mtl_write(FileWriter *writer, const ExportSource *source, char (*name)[MTL_NAME],
               const char *file, Error *e);

#endif
