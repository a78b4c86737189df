// Imported meshes and envelopes that are drawn as they are.
#include "scene/drawn.h"
#include "scene/spec_check.h"

static const Key MESH_KEYS[] = {
    {KEY_OF(SceneMesh, file, "file", KEY_FILE), .flags = KEY_REQUIRED,
     .doc = "OBJ, PLY, STL, glTF or GLB file, relative to the scene's folder."},
    {KEY_OF(SceneMesh, smooth, "smooth", KEY_BOOL),
     .doc = "Make smooth normals when the file has none."},
    {KEY_OF(SceneMesh, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Where the mesh's origin goes."},
    {KEY_OF(SceneMesh, rotation, "rotation", KEY_VECTOR), .count = 3, .unit = "degrees",
     .doc = "Turns about x, then y, then z."},
    {KEY_OF(SceneMesh, scale, "scale", KEY_VECTOR), .flags = KEY_SPLAT, .count = 3,
     .doc = "Factors along x, y and z, before the turns; negative ones mirror."},
    {0},
};

static void mesh_defaults(void *out)
{
    *(SceneMesh *)out = (SceneMesh){.scale = {1, 1, 1}};
}

static bool check_mesh(const Mapping *mapping, void *params)
{
    const SceneMesh *mesh = params;
    return check_mesh_file(mapping, mesh->file) && check_scale(mapping, mesh->scale);
}

const Table mesh_table = {
    .name = "mesh",
    .doc = "A mesh that another program made. Material: clay, if the object names no other.",
    .size = sizeof(SceneMesh),
    .keys = MESH_KEYS,
    .defaults = mesh_defaults,
    .check = check_mesh};

static const Key SOLID_KEYS[] = {
    {KEY_OF(SceneShape, shapes, "envelope", KEY_LIST),
     .count_offset = offsetof(SceneShape, shape_count), .flags = KEY_REQUIRED, .low = 1,
     .count = 1000, .table = &shape_table,
     .doc = "Shapes joined, cut and intersected in this order."},
    {KEY_OF(SceneShape, voxel, "voxel", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Voxel size where it is not one plain shape; 0 = 1/128 of the largest extent."},
    {0},
};

static void solid_defaults(void *out)
{
    *(SceneShape *)out = (SceneShape){0};
}

static bool check_solid(const Mapping *mapping, void *params)
{
    const SceneShape *solid = params;
    return check_shapes(mapping, solid->shapes, solid->shape_count);
}

const Table solid_table = {
    .name = "solid",
    .doc = "Spheres, boxes, bodies and what they cut out of each other, drawn as they are. "
           "Material: clay, if the object names no other.",
    .example = "objects:\n"
               "  - name: bowl\n"
               "    shape:\n"
               "      envelope:\n"
               "        - {shape: sphere, size: 0.5}\n"
               "        - {shape: sphere, size: 0.45, op: difference}\n"
               "        - {shape: half_space, op: intersection}\n",
    .size = sizeof(SceneShape),
    .keys = SOLID_KEYS,
    .defaults = solid_defaults,
    .check = check_solid};
