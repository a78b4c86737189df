// Exports a scene to a file of another program.
#ifndef RAMIFY_SCENE_EXPORT_SCENE_H
#define RAMIFY_SCENE_EXPORT_SCENE_H

#include "export/export.h"
#include "scene/scene.h"

// What was written, with instances expanded and curves as tubes; all 0 for formats without
// surfaces.
typedef struct ExportReport {
    int64_t vertices, triangles;
    Aabb bounds; // m
} ExportReport;

// Grows, skins and places what the file's format needs and writes it. The file extension selects
// the format. If the options name objects, only these are written. ERROR_INPUT names the known
// extensions or objects. report may be NULL.
bool scene_export(const Scene *scene, const char *file, const ExportOptions *options,
                  const Run *run, ExportReport *report, Error *e);

// Writes existing growth: either the out-trees or the lands of the scene's objects (the other
// argument is NULL; entries are NULL for objects without one). The file extension selects the
// format.
bool scene_write_grown(const Scene *scene, const OutTree *const *trees,
                       const HeightField *const *lands, const char *file, const Run *run, Error *e);

// ERROR_INPUT when no format has the file's extension.
bool scene_export_check(const char *file, Error *e);

#endif
