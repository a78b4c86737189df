// From a scene to another program's file.
#ifndef RAMIFY_SCENE_EXPORT_SCENE_H
#define RAMIFY_SCENE_EXPORT_SCENE_H

#include "export/export.h"
#include "scene/scene.h"

// Grows, skins and places what the format of the file's ending needs, and writes it. ERROR_INPUT
// names the endings there are.
bool scene_export(const Scene *scene, const char *file, const Run *run, Error *e);

// ERROR_INPUT when the file's ending is that of no format.
bool scene_export_check(const char *file, Error *e);

#endif
