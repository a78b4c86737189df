// The keys of a row.
#include "objects/common/tables.h"
#include "objects/row/row.h"

RowParams row_params_default(void)
{
    return (RowParams){
        .on_land = true, .spacing = 1.0f, .scale = {1.0f, 1.0f}, .things.variants = 3};
}

static const Key POINT_KEYS[] = {
    {KEY_OF(RowPoint, at, "at", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3, .low = -1e6,
     .high = 1e6, .unit = "m", .doc = "Where it is; with on_land its height does not matter."},
    {0},
};

static void point_defaults(void *out)
{
    *(RowPoint *)out = (RowPoint){{0}};
}

static const Table POINT_TABLE = {.name = "row_point",
                                  .doc = "A corner of the line.",
                                  .size = sizeof(RowPoint),
                                  .keys = POINT_KEYS,
                                  .defaults = point_defaults};

static const Key ROW_KEYS[] = {
    THINGS_ROWS(RowParams),
    {KEY_OF(RowParams, points, "points", KEY_LIST), .flags = KEY_REQUIRED, .low = 2,
     .count_offset = offsetof(RowParams, point_count), .count = 10000, .table = &POINT_TABLE,
     .doc = "Corners of the line, from its start to its end."},
    {KEY_OF(RowParams, spacing, "spacing", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e5, .unit = "m",
     .doc = "Distance from copy to copy along the line; it is made to fit, so that copies stand at "
            "both ends."},
    {KEY_OF(RowParams, on_land, "on_land", KEY_BOOL),
     .doc = "Stand on the land, or on the object `on`, below or above the line; false = at the "
            "line's own height, as the planks of a jetty."},
    {KEY_OF(RowParams, on, "on", KEY_TEXT),
     .doc = "Name of the object on which the copies stand: a terrain, or another whose meshes are "
            "seen from above. Default: the ground of the scene, or level land at height 0."},
    {KEY_OF(RowParams, scale, "scale", KEY_VECTOR), .flags = KEY_ABOVE, .count = 2, .high = 1000,
     .doc = "Smallest and largest size of a copy, relative to the thing's."},
    {KEY_OF(RowParams, align, "align", KEY_FLOAT), .high = 1,
     .doc = "How far copies turn from upright (0), as posts, to the line's rise (1), as rails."},
    {KEY_OF(RowParams, sink, "sink", KEY_FLOAT), .low = -1000, .high = 1000, .unit = "m",
     .doc = "Depth of the origin below the land or line, for a copy of scale 1."},
    {KEY_OF(RowParams, jitter, "jitter", KEY_VECTOR), .count = 3, .high = 1e5, .unit = "m",
     .doc = "Greatest random displacement across the line, upward, and along the line."},
    {KEY_OF(RowParams, turn, "turn", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Greatest random rotation about the vertical; 180 = any."},
    {KEY_OF(RowParams, tilt, "tilt", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Greatest random lean, to any side."},
    {KEY_OF(RowParams, gaps, "gaps", KEY_FLOAT), .high = 1,
     .doc = "Share of the places where nothing stands: lost posts, dead trees."},
    VARIANTS_ROW(RowParams),
    {0},
};

static bool check_row(const Mapping *mapping, void *params)
{
    const RowParams *row = params;
    if (row->on && !row->on_land) {
        return mapping_fail(mapping, "on_land", " is false; then there can be no key 'on'");
    }
    if (row_count(row) > 10000000) {
        return mapping_fail(mapping, "spacing", " is %g m; that makes more than 1e7 copies",
                            (double)row->spacing);
    }
    return check_range(mapping, "scale", row->scale);
}

static void row_defaults(void *out)
{
    *(RowParams *)out = row_params_default();
}

const Table row_table = {
    .name = "row",
    .doc = "Copies of any objects along a line: posts of a fence, planks of a jetty, trees of an "
           "avenue. A copy's z axis points along the line, its y axis up.",
    .example = "objects:\n"
               "  - name: posts\n"
               "    row:\n"
               "      points: [{at: [-6, 0, 0]}, {at: [0, 0, -2]}, {at: [8, 0, -2]}]\n"
               "      spacing: 2.5\n"
               "      tilt: 4\n"
               "      things:\n"
               "        - {shape: {envelope: [{shape: cone, size: [0.06, 1.3, 0.05]}]}}\n",
    .size = sizeof(RowParams),
    .keys = ROW_KEYS,
    .defaults = row_defaults,
    .check = check_row};
