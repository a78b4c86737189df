// The registry of formats: FORMAT(name) is name_format, defined in the file that writes it.
// The first whose ending a file's name has writes it.
#ifndef RAMIFY_EXPORT_FORMATS_H
#define RAMIFY_EXPORT_FORMATS_H

#include "export/export.h"

#define EXPORT_FORMATS(FORMAT) \
    FORMAT(glb)                \
    FORMAT(obj)                \
    FORMAT(ply)                \
    FORMAT(usda)               \
    FORMAT(pov)                \
    FORMAT(stl)                \
    FORMAT(swc)                \
    FORMAT(network)            \
    FORMAT(vtp)                \
    FORMAT(json)               \
    FORMAT(graphml)            \
    FORMAT(vdb)                \
    FORMAT(csv)                \
    FORMAT(asc)                \
    FORMAT(tif)                \
    FORMAT(exr)                \
    FORMAT(png)

#define FORMAT(name) extern const ExportFormat name##_format;
EXPORT_FORMATS(FORMAT)
#undef FORMAT

#endif
