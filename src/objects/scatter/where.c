#include "objects/scatter/where.h"

#include "base/memory.h"
#include "land/height_maps.h"
#include "land/height_raster.h"
#include "objects/common/tables.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = 1024 }; // samples of a map
enum { ASPECT = 1 };  // of MAPS: an angle, whose ranges may lead through north

static const EnumName MAPS[] = {{"slope", 0}, {"aspect", ASPECT}, {"curvature", 2},
                                {"flow", 3},  {"wetness", 4},     {"river-distance", 5},
                                {0}};

// ---- maps

// The land under the disc, with a margin for what the maps look at around a sample.
static HeightField *sample_land(const ScatteringParams *params, const Land *land, Error *e)
{
    float half = 1.05f * params->radius, cell = 2.0f * half / (float)(SIDE - 1);
    Vec2 origin = {params->center.x - half, params->center.z - half};
    HeightField *field = height_field_new(SIDE, SIDE, (Vec2){cell, cell}, origin, e);
    for (int64_t i = 0; field && i < height_field_count(field); i++) {
        int column = (int)(i % SIDE), row = (int)(i / SIDE);
        field->height[i] =
            land_height(land, origin.x + (float)column * cell, origin.y + (float)row * cell);
    }
    return field;
}

bool where_init(Where *where, const ScatteringParams *params, const ShapeSurface *surface,
                const Land *land, Error *e)
{
    *where = (Where){0};
    if (params->where_count == 0) {
        return true;
    }
    HeightField *field =
        surface ? height_field_of_mesh(surface->mesh, SIDE, e) : sample_land(params, land, e);
    where->map = field ? memory_alloc_zero(params->where_count, sizeof(HeightField *), e) : NULL;
    bool done = where->map;
    while (done && where->count < params->where_count) {
        const char *name = enum_name(MAPS, params->where[where->count].map);
        where->map[where->count] = height_map(field, name, e);
        done = where->map[where->count++];
    }
    height_field_free(field);
    return done;
}

void where_free(Where *where)
{
    for (int i = 0; i < where->count; i++) {
        height_field_free(where->map[i]);
    }
    free(where->map);
    *where = (Where){0};
}

// ---- places

// The nearest sample: aspects cannot be interpolated, and what is missing should stay so.
static float value_at(const HeightField *field, Vec3 p)
{
    float u = (p.x - field->origin.x) / field->cell.x, v = (p.z - field->origin.y) / field->cell.y;
    int column = (int)lrintf(clampf(u, 0.0f, (float)(field->columns - 1)));
    int row = (int)lrintf(clampf(v, 0.0f, (float)(field->rows - 1)));
    return field->height[(int64_t)row * field->columns + column];
}

// How far a value lies outside of the range; 0 within it.
static float excess(const MapRange *range, float value)
{
    float below = range->range[0] - value, above = value - range->range[1];
    if (range->map != ASPECT) {
        return fmaxf(fmaxf(below, above), 0.0f);
    }
    if (value < 0.0f) {
        return INFINITY; // level land faces nowhere
    }
    bool through_north = range->range[0] > range->range[1];
    bool within = through_north ? below <= 0.0f || above <= 0.0f : below <= 0.0f && above <= 0.0f;
    float to_low = fminf(fabsf(below), 360.0f - fabsf(below));
    float to_high = fminf(fabsf(above), 360.0f - fabsf(above));
    return within ? 0.0f : fminf(to_low, to_high);
}

float where_share(const Where *where, const ScatteringParams *params, Vec3 p)
{
    float share = 1.0f;
    for (int i = 0; i < where->count; i++) {
        const MapRange *range = &params->where[i];
        float value = value_at(where->map[i], p);
        float off = isfinite(value) ? excess(range, value) : INFINITY;
        share *= range->fade > 0.0f ? fmaxf(1.0f - off / range->fade, 0.0f) : (float)(off <= 0.0f);
    }
    return share;
}

// ---- keys

static const Key KEYS[] = {
    {KEY_OF(MapRange, map, "map", KEY_ENUM), .flags = KEY_REQUIRED, .names = MAPS,
     .doc =
         "slope: degrees from level; aspect: degrees toward which the land falls, 0 = north (-z), "
         "90 = east (+x); curvature: 1/m, positive in hollows, negative on ridges; flow: m^2 of "
         "catchment; wetness: the topographic index ln(catchment per m of contour / slope), about "
         "5 on ridges and 15 in valleys; river-distance: m to the nearest river."},
    {KEY_OF(MapRange, range, "range", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2, .low = -1e9,
     .high = 1e9,
     .doc =
         "Least and greatest value, in the map's unit. Of aspect, [300, 60] leads through north."},
    {KEY_OF(MapRange, fade, "fade", KEY_FLOAT), .high = 1e9,
     .doc = "Distance from the range, in the map's unit, over which copies become fewer; 0 = none "
            "outside."},
    {0},
};

static bool check(const Mapping *mapping, void *params)
{
    const MapRange *range = params;
    return range->map == ASPECT || range->range[0] <= range->range[1] ||
           mapping_fail(mapping, "range", " is [%g, %g]; the first must not exceed the second",
                        (double)range->range[0], (double)range->range[1]);
}

const Table where_table = {
    .name = "where",
    .doc = "A condition on a map of the surface seen from above, of 1024 x 1024 samples over its "
           "bounds, or of the land under the disc. `ramify grow SCENE --map NAME -o map.png` shows "
           "the maps of a terrain.",
    .example = "objects:\n"
               "  - name: land\n"
               "    terrain: {size: 400, resolution: 256}\n"
               "  - name: stones\n"
               "    scatter:\n"
               "      on: land\n"
               "      radius: 0\n"
               "      count: 500\n"
               "      where:\n"
               "        - {map: slope, range: [25, 60], fade: 5}\n"
               "        - {map: aspect, range: [90, 270]}\n"
               "      things: [{stone: {size: 2}}]\n",
    .size = sizeof(MapRange),
    .keys = KEYS,
    .check = check};
