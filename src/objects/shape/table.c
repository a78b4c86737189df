// The keys of envelopes that are drawn as they are.
#include "objects/common/tables.h"
#include "objects/shape/shape.h"

static const Key SOLID_KEYS[] = {
    {KEY_OF(SolidParams, shapes, "envelope", KEY_LIST),
     .count_offset = offsetof(SolidParams, shape_count), .flags = KEY_REQUIRED, .low = 1,
     .count = 1000, .table = &shape_table, .doc = "Shapes, combined in this order."},
    {KEY_OF(SolidParams, voxel, "voxel", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Voxel size, unless the envelope is a single plain shape; 0 = 1/128 of the largest "
            "extent."},
    {KEY_OF(SolidParams, checks, "checks", KEY_FLOAT), .high = 1, .unit = "m",
     .doc =
         "Carves the shape as wood that has stood outside for years, with its fibres along its y "
         "axis: worn grain, knots, swellings, and radial cracks (checks), the deepest this "
         "deep; 0 = not of wood. It is a level set then, and a voxel of 0.001 shows all. "
         "Material: pattern wood."},
    {KEY_OF(SolidParams, hoar, "hoar", KEY_GROUP), .table = &hoar_table,
     .doc = "Hoar frost on the surface."},
    {0},
};

static void solid_defaults(void *out)
{
    *(SolidParams *)out = (SolidParams){.hoar = hoar_params_default()};
}

static bool check_solid(const Mapping *mapping, void *params)
{
    const SolidParams *solid = params;
    return check_shapes(mapping, "envelope", solid->shapes, solid->shape_count);
}

const Table solid_table = {
    .name = "solid",
    .doc = "Spheres, boxes, bodies and their combinations, rendered as solids. Material: clay.",
    .example = "objects:\n"
               "  - name: bowl\n"
               "    shape:\n"
               "      envelope:\n"
               "        - {shape: sphere, size: 0.5}\n"
               "        - {shape: sphere, size: 0.45, op: difference}\n"
               "        - {shape: half_space, op: intersection}\n",
    .size = sizeof(SolidParams),
    .keys = SOLID_KEYS,
    .defaults = solid_defaults,
    .check = check_solid};
