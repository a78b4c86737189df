// The writers of all formats, for the table in export.c. Each is documented at its top.
#ifndef RAMIFY_EXPORT_FORMATS_H
#define RAMIFY_EXPORT_FORMATS_H

#include "export/export.h"

bool export_glb(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_obj(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_ply(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_usda(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_pov(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_stl(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_tree_each(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_graphml(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_vdb(const ExportSource *source, const char *file, const Run *run, Error *e);
bool export_heights(const ExportSource *source, const char *file, const Run *run, Error *e);

#endif
