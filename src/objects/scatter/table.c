// The keys of scattering.
#include "objects/common/tables.h"
#include "objects/scatter/scatter.h"

#include <string.h>

ScatteringParams scattering_params_default(void)
{
    return (ScatteringParams){.count = 1000,
                              .radius = 20.0f,
                              .clumping = 0.5f,
                              .clump_size = 4.0f,
                              .scale = {0.7f, 1.2f},
                              .stretch = {1.0f, 1.0f},
                              .slope = {0.0f, 90.0f},
                              .altitude = {-1e6f, 1e6f},
                              .things.variants = 3};
}

static const Key SCATTER_KEYS[] = {
    THINGS_ROWS(ScatteringParams),
    {KEY_OF(ScatteringParams, on, "on", KEY_TEXT),
     .doc = "Name of the object on whose meshes the copies stand: a terrain, a shape, an imported "
            "mesh. Default: the ground of the scene, or level land at height 0."},
    {KEY_OF(ScatteringParams, count, "count", KEY_INT64), .low = 1, .high = 1e8,
     .doc = "Number of copies; fewer, with a warning, if there is no room for all."},
    {KEY_OF(ScatteringParams, center, "center", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the disc, or on an object of the ball, in which they stand."},
    {KEY_OF(ScatteringParams, radius, "radius", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Maximum distance from the centre; on an object 0 = all of it."},
    {KEY_OF(ScatteringParams, inner, "inner", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Minimum distance from the centre."},
    {KEY_OF(ScatteringParams, beyond, "beyond", KEY_INT), .high = 8,
     .doc =
         "Rings of the copies around a terrain (its key beyond) on which the copies stand, too, "
         "as on the terrain itself: each of them as many again, 8 times in the first ring, 16 "
         "times in the second. Where the land is drawn of tiles, whose mesh holds the copies, too, "
         "they are then sought in the square alone and stand on each copy's own ground, but not "
         "in its water."},
    {KEY_OF(ScatteringParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = each thing in patches of its own."},
    {KEY_OF(ScatteringParams, clump_size, "clump_size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6,
     .unit = "m", .doc = "Distance from patch to patch."},
    {KEY_OF(ScatteringParams, spacing, "spacing", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Minimum distance between two copies; 0 = none."},
    {KEY_OF(ScatteringParams, scale, "scale", KEY_VECTOR), .flags = KEY_ABOVE, .count = 2,
     .high = 1000, .doc = "Smallest and largest size of a copy, relative to the thing's."},
    {KEY_OF(ScatteringParams, stretch, "stretch", KEY_VECTOR), .flags = KEY_ABOVE, .count = 2,
     .high = 100,
     .doc = "Least and greatest factor on a copy's height alone: [0.85, 1.2] makes slender and "
            "stout trees of the same few."},
    {KEY_OF(ScatteringParams, tilt, "tilt", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Greatest random lean, to any side."},
    {KEY_OF(ScatteringParams, slope, "slope", KEY_VECTOR), .count = 2, .high = 180,
     .unit = "degrees", .doc = "Least and greatest slope of the places: 0 = level, 90 = a wall."},
    {KEY_OF(ScatteringParams, altitude, "altitude", KEY_VECTOR), .count = 2, .low = -1e6,
     .high = 1e6, .unit = "m", .doc = "Lowest and highest place."},
    {KEY_OF(ScatteringParams, where, "where", KEY_LIST),
     .count_offset = offsetof(ScatteringParams, where_count), .count = 16,
     .table = &map_range_table,
     .doc = "Conditions on maps of the land, which all hold where copies stand."},
    {KEY_OF(ScatteringParams, align, "align", KEY_FLOAT), .high = 1,
     .doc = "How far copies turn from upright (0) to the surface's normal (1)."},
    {KEY_OF(ScatteringParams, sink, "sink", KEY_FLOAT), .low = -1000, .high = 1000, .unit = "m",
     .doc = "Depth of the origin below the surface, for a copy of scale 1."},
    {KEY_OF(ScatteringParams, in_water, "in_water", KEY_BOOL),
     .doc = "Stand in water, as reeds do, instead of outside of it; water is that of other objects "
            "and the lakes and rivers of the land. A condition on water-depth decides alone."},
    {KEY_OF(ScatteringParams, afloat, "afloat", KEY_BOOL),
     .doc = "With in_water: float on the water's surface, upright, as water lilies' leaves do, "
            "instead of standing on its bed. altitude is still that of the bed: it tells how deep "
            "the water may be."},
    VARIANTS_ROW(ScatteringParams),
    {0},
};

int64_t scattering_most(const ScatteringParams *params)
{
    int64_t across = 2 * params->beyond + 1;
    return across * across * params->count;
}

static bool check_scatter(const Mapping *mapping, void *params)
{
    const ScatteringParams *scatter = params;
    if (!check_range(mapping, "scale", scatter->scale) ||
        !check_range(mapping, "stretch", scatter->stretch) ||
        !check_range(mapping, "slope", scatter->slope) ||
        !check_range(mapping, "altitude", scatter->altitude)) {
        return false;
    }
    if (!scatter->on && !(scatter->radius > 0.0f)) {
        return mapping_fail(mapping, "radius", " is 0 m; on the land it must be greater");
    }
    if (scatter->beyond > 0 && !scatter->on) {
        return mapping_fail(mapping, "beyond",
                            " is %d; 'on' must name the terrain whose copies it is about",
                            scatter->beyond);
    }
    if (scatter->afloat && !scatter->in_water) {
        return mapping_fail(mapping, "afloat", " is true; then in_water must be true, too");
    }
    return scatter->inner < scatter->radius || scatter->radius == 0.0f ||
           mapping_fail(mapping, "inner", " is %g m; it must be less than radius, %g m",
                        (double)scatter->inner, (double)scatter->radius);
}

static void scatter_defaults(void *out)
{
    *(ScatteringParams *)out = scattering_params_default();
}

const Table scatter_table = {
    .name = "scatter",
    .doc = "Copies of any objects over the land or over the surface of another object: flowers, "
           "stones, shrubs, trees, imported meshes.",
    .example = "objects:\n"
               "  - name: meadow\n"
               "    ground: {grass_tufts: 20000}\n"
               "  - name: flowers\n"
               "    scatter: {count: 400, radius: 12, clumping: 0.8, things: [{tree: {species: "
               "oxeye_daisy}}]}\n",
    .size = sizeof(ScatteringParams),
    .keys = SCATTER_KEYS,
    .defaults = scatter_defaults,
    .check = check_scatter};
