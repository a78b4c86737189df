#include "export/export.h"

#include "base/file_name.h"
#include "export/formats.h"

#include <stddef.h>

static const ExportFormat FORMATS[] = {
    {".glb", "glTF 2.0 in one file: meshes, materials, camera, lights", 0, EXPORT_WORLD,
     export_glb},
    {".obj", "meshes with materials beside it (.mtl)", 0, EXPORT_WORLD, export_obj},
    {".ply", "meshes with radius and birth, binary", 0, EXPORT_WORLD, export_ply},
    {".usda", "USD as text: all of the scene", (int)(sizeof "-sky.exr" - sizeof ".usda"),
     EXPORT_WORLD, export_usda},
    {".pov", "a scene that POV-Ray renders as it is; pictures in NAME-textures/",
     (int)(sizeof "-textures" - sizeof ".pov"), EXPORT_WORLD, export_pov},
    {".stl", "triangles alone, binary", 0, EXPORT_WORLD, export_stl},
    {".swc", "an out-tree: nodes with radius and parent", 0, EXPORT_TREES, export_tree_each},
    {".json", "an out-tree with all that is known of it", 0, EXPORT_TREES, export_tree_each},
    {".graphml", "all out-trees as graphs", 0, EXPORT_TREES, export_graphml},
    {".vdb", "envelopes and guide fields as OpenVDB grids", 0, EXPORT_GRIDS, export_vdb},
    {".asc", "heights of land, Esri ASCII grid", 0, EXPORT_LAND, export_heights},
    {".exr", "heights of land, float picture", 0, EXPORT_LAND, export_heights},
    {".png", "heights of land, 16-bit picture", 0, EXPORT_LAND, export_heights},
};

enum { FORMAT_COUNT = (int)(sizeof FORMATS / sizeof FORMATS[0]) };

const ExportFormat *export_format(const char *file)
{
    for (int i = 0; i < FORMAT_COUNT; i++) {
        if (file_name_ends(file, FORMATS[i].ending)) {
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
