// From a scene to another program's file.
#ifndef RAMIFY_SCENE_EXPORT_SCENE_H
#define RAMIFY_SCENE_EXPORT_SCENE_H

#include "export/export.h"
#include "scene/scene.h"

// What was written, with instances written out and curves as tubes; all 0 for formats that are not
// made of surfaces.
typedef struct ExportReport {
    int64_t vertices, triangles;
    Aabb bounds; // m
} ExportReport;

// Grows, skins and places what the format of the file's ending needs, and writes it; of the objects
// that the options name alone, where they name any. ERROR_INPUT names the endings or the objects
// there are. report may be NULL.
bool scene_export(const Scene *scene, const char *file, const ExportOptions *options,
                  const Run *run, ExportReport *report, Error *e);

// Writes what has been grown already: the out-trees or (the other NULL) the lands of the scene's
// objects, NULL where one has none, by the file's ending.
bool scene_write_grown(const Scene *scene, const OutTree *const *trees,
                       const HeightField *const *lands, const char *file, const Run *run, Error *e);

// ERROR_INPUT when the file's ending is that of no format.
bool scene_export_check(const char *file, Error *e);

#endif
