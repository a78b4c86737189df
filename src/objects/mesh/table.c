// The keys of an imported mesh.
#include "objects/common/tables.h"
#include "objects/mesh/mesh.h"

static const Key MESH_KEYS[] = {
    {KEY_OF(MeshParams, file, "file", KEY_FILE), .flags = KEY_REQUIRED,
     .doc = "OBJ, PLY, STL, glTF, GLB or VDB file, relative to the scene's folder."},
    {KEY_OF(MeshParams, smooth, "smooth", KEY_BOOL),
     .doc = "Compute smooth normals if the file has none."},
    {KEY_OF(MeshParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the mesh's origin."},
    {KEY_OF(MeshParams, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Rotation about x, then y, then z."},
    {KEY_OF(MeshParams, scale, "scale", KEY_VECTOR), .flags = KEY_SPLAT, .count = 3,
     .doc = "Scale along x, y and z, applied before the rotation; negative values mirror."},
    {KEY_OF(MeshParams, bend_front, "bend_front", KEY_FLOAT), .low = -170, .high = 170,
     .unit = "degrees",
     .doc = "Bends the half of the mesh at its high x, as a fish bends its head: its end is turned "
            "by so much, toward z. Before scale."},
    {KEY_OF(MeshParams, bend_back, "bend_back", KEY_FLOAT), .low = -170, .high = 170,
     .unit = "degrees",
     .doc = "The same of the half at the low x, such as its tail, toward z, too."},
    {KEY_OF(MeshParams, hoar, "hoar", KEY_GROUP), .table = &hoar_table,
     .doc = "Hoar frost on the surface; faces must face outward."},
    {0},
};

static void mesh_defaults(void *out)
{
    *(MeshParams *)out = (MeshParams){.scale = {1, 1, 1}, .hoar = hoar_params_default()};
}

static bool check_mesh(const Mapping *mapping, void *params)
{
    const MeshParams *mesh = params;
    return check_mesh_file(mapping, mesh->file) && check_scale(mapping, mesh->scale);
}

const Table mesh_table = {.name = "mesh",
                          .doc = "A mesh imported from a file. Material: clay.",
                          .size = sizeof(MeshParams),
                          .keys = MESH_KEYS,
                          .defaults = mesh_defaults,
                          .check = check_mesh};
