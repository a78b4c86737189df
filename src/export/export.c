#include "export/export.h"

#include "export/formats.h"

#include <string.h>
#include <strings.h>

static const ExportFormat FORMATS[] = {
    {".glb", "glTF 2.0 in one file: meshes, materials, camera, lights", EXPORT_WORLD, export_glb},
    {".obj", "meshes with materials beside it (.mtl)", EXPORT_WORLD, export_obj},
    {".ply", "meshes with radius and birth, binary", EXPORT_WORLD, export_ply},
    {".usda", "USD as text: all of the scene", EXPORT_WORLD, export_usda},
    {".stl", "triangles alone, binary", EXPORT_WORLD, export_stl},
};

enum { FORMAT_COUNT = (int)(sizeof FORMATS / sizeof FORMATS[0]) };

const ExportFormat *export_format(const char *file)
{
    size_t length = strlen(file);
    for (int i = 0; i < FORMAT_COUNT; i++) {
        size_t ending = strlen(FORMATS[i].ending);
        if (length > ending && strcasecmp(file + length - ending, FORMATS[i].ending) == 0) {
            return &FORMATS[i];
        }
    }
    return NULL;
}

int export_format_count(void)
{
    return FORMAT_COUNT;
}

const ExportFormat *export_format_at(int index)
{
    return &FORMATS[index];
}
