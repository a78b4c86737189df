// The keys of a stone.
#include "objects/common/tables.h"
#include "objects/stone/stone.h"

StoneParams stone_params_default(void)
{
    return (StoneParams){.size = 0.5f,
                         .width = 0.75f,
                         .height = 0.6f,
                         .faces = 14,
                         .roundness = 0.35f,
                         .roughness = 0.03f,
                         .sink = 0.25f,
                         .resolution = 24};
}

static const Key STONE_KEYS[] = {
    {KEY_OF(StoneParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Place on the ground."},
    {KEY_OF(StoneParams, rotation, "rotation", KEY_VECTOR), .count = 3, .low = -36000,
     .high = 36000, .unit = "degrees", .doc = "Rotation about x, then y, then z."},
    {KEY_OF(StoneParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e4, .unit = "m",
     .doc = "Length, its largest extent."},
    {KEY_OF(StoneParams, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1,
     .doc = "Width, relative to the length."},
    {KEY_OF(StoneParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1,
     .doc = "Height, relative to the length."},
    {KEY_OF(StoneParams, faces, "faces", KEY_INT), .low = 6, .high = 64,
     .doc = "Number of planes along which it broke."},
    {KEY_OF(StoneParams, roundness, "roundness", KEY_FLOAT), .high = 1,
     .doc = "From sharp edges (0) to a pebble (1)."},
    {KEY_OF(StoneParams, roughness, "roughness", KEY_FLOAT), .high = 0.3,
     .doc = "Height of its bumps, relative to its size; finer ones by its material."},
    {KEY_OF(StoneParams, sink, "sink", KEY_FLOAT), .high = 0.95,
     .doc = "Share of its height that is below the ground."},
    {KEY_OF(StoneParams, resolution, "resolution", KEY_INT), .low = 4, .high = 500,
     .doc = "Faces of its mesh along each side."},
    {0},
};

static void stone_defaults(void *out)
{
    *(StoneParams *)out = stone_params_default();
}

const Table stone_table = {
    .name = "stone",
    .doc = "A stone or boulder: a block with flat faces, more or less rounded. Many of them: "
           "scatter. Material: fieldstone.",
    .example = "objects:\n"
               "  - name: boulder\n"
               "    stone: {size: 1.4, roundness: 0.2, sink: 0.35}\n",
    .size = sizeof(StoneParams),
    .keys = STONE_KEYS,
    .defaults = stone_defaults};
