// Materials for OBJ files: Kd, Ks, Ns, d, Ni, Ke and the Pr, Pm of physically based readers.
#ifndef RAMIFY_EXPORT_MTL_H
#define RAMIFY_EXPORT_MTL_H

#include "base/file_writer.h"
#include "export/export.h"

enum { MTL_NAME = 64 };

// The material's name as OBJ and MTL have it: without blanks.
void mtl_name(const Material *material, char name[MTL_NAME]);

// All materials that the source's parts use; pictures by their path from the folder of `file`.
// ERROR_IO when a picture is not there.
bool mtl_write(FileWriter *writer, const ExportSource *source, const char *file, Error *e);

#endif
