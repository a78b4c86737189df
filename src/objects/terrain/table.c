// The terrain: uplift, rivers, ridges, noise, erosion, forest.
#include "land/tiles.h"
#include "objects/common/tables.h"
#include "objects/terrain/delta.h"

#include <stdio.h>

static const Key STROKE_KEYS[] = {
    {KEY_OF(UpliftStroke, from, "from", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2,
     .unit = "sizes",
     .doc = "Start of the stroke: x and z as fractions of the terrain's size; [0, 0] = the centre, "
            "[-0.5, -0.5] = the north-west corner."},
    {KEY_OF(UpliftStroke, to, "to", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2, .unit = "sizes",
     .doc = "End of the stroke; the same point as `from` makes a round spot."},
    {KEY_OF(UpliftStroke, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "sizes", .doc = "Distance at which the stroke has faded to zero."},
    {KEY_OF(UpliftStroke, strength, "strength", KEY_FLOAT), .low = -100, .high = 100,
     .doc = "Uplift added along the stroke's middle; a negative value lowers the land."},
    {0},
};

static void stroke_defaults(void *out)
{
    *(UpliftStroke *)out = (UpliftStroke){.radius = 0.25f, .strength = 2.0f};
}

static const Table STROKE_TABLE = {.name = "uplift_stroke",
                                   .doc = "A brush stroke that raises land.",
                                   .size = sizeof(UpliftStroke),
                                   .keys = STROKE_KEYS,
                                   .defaults = stroke_defaults};

static const Key UPLIFT_KEYS[] = {
    {KEY_OF(UpliftParams, base, "base", KEY_FLOAT), .high = 100,
     .doc = "Uplift where there is no stroke."},
    {KEY_OF(UpliftParams, noise, "noise", KEY_FLOAT), .high = 1,
     .doc = "Variation of the uplift from place to place."},
    {KEY_OF(UpliftParams, strokes, "strokes", KEY_LIST),
     .count_offset = offsetof(UpliftParams, stroke_count), .count = 1000, .table = &STROKE_TABLE,
     .doc = "Brush strokes that raise or lower land."},
    {KEY_OF(UpliftParams, image, "image", KEY_FILE),
     .doc = "Grey image laid over the terrain, north up; it multiplies the uplift."},
    {0},
};

static const Table UPLIFT_TABLE = {.name = "uplift",
                                   .doc = "Uplift of the land: high uplift makes mountains.",
                                   .size = sizeof(UpliftParams),
                                   .keys = UPLIFT_KEYS};

// The rows of a tree that is not grown.
#define SOURCE_ROWS(STRUCT, PART)                                                                 \
    {KEY_OF(STRUCT, source.file, "file", KEY_FILE),                                               \
     .doc = "SWC file with the tree of " PART ", instead of growing one: x and z of its nodes, "  \
            "from the terrain's centre. Heights in it are ignored."},                             \
        {KEY_OF(STRUCT, source.scale, "scale", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e9,       \
         .unit = "m", .doc = "Length of the file's unit."},                                       \
        {KEY_OF(STRUCT, source.image, "image", KEY_FILE),                                         \
         .doc = "Image laid over the terrain, north up, in which " PART " are painted as bright " \
                "lines on dark, instead of growing a tree. Lines that form a loop are parted "    \
                "where it is farthest from the root."},                                           \
    {                                                                                             \
        KEY_OF(STRUCT, source.invert, "invert", KEY_BOOL),                                        \
            .doc = "The image has dark lines on bright."                                          \
    }

static bool check_source(const Mapping *mapping, const TreeSource *source)
{
    return !source->file || !source->image ||
           mapping_fail(mapping, "image",
                        ": the tree already comes from a file; give a file or an image");
}

static const EnumName SIDES[] = {{"all", SIDE_ALL},     {"north", SIDE_NORTH}, {"east", SIDE_EAST},
                                 {"south", SIDE_SOUTH}, {"west", SIDE_WEST},   {0}};

static const Key RIVER_KEYS[] = {
    SOURCE_ROWS(RiverParams, "rivers"),
    {KEY_OF(RiverParams, outlets, "outlets", KEY_INT), .low = 1, .high = 10000,
     .doc = "Number of rivers that leave the terrain."},
    {KEY_OF(RiverParams, side, "side", KEY_ENUM), .names = SIDES,
     .doc = "Side of the terrain where the rivers leave."},
    {KEY_OF(RiverParams, count, "count", KEY_INT64), .low = 12, .high = 4e6,
     .doc = "Number of attractors of the finest level, about the number of brooks; few make long "
            "slopes."},
    {KEY_OF(RiverParams, winding, "winding", KEY_FLOAT), .high = 1,
     .doc = "How far rivers wind: noise of their growth, and meanders added to main rivers."},
    {KEY_OF(RiverParams, gradient, "gradient", KEY_FLOAT), .high = 0.9,
     .doc = "Gradient of brooks, as a fraction of the slopes' gradient."},
    {KEY_OF(RiverParams, concavity, "concavity", KEY_FLOAT), .high = 2,
     .doc = "Concavity index: rivers flatten with their drainage area to the power of -concavity; "
            "0.42 in nature."},
    {KEY_OF(RiverParams, valley, "valley", KEY_FLOAT), .high = 1,
     .doc = "Half-width of valley floors, as a fraction of the square root of the drainage area."},
    {KEY_OF(RiverParams, water, "water", KEY_FLOAT), .high = 1,
     .doc = "Half-width of the water, as a fraction of the square root of the drainage area; 0 = "
            "dry. Only rivers wider than 1.2 cells are visible."},
    {KEY_OF(RiverParams, runoff, "runoff", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .unit = "m3/s/km2",
     .doc = "Water that a square kilometre of drainage area sends down; 0.15 = mountains after "
            "rain, 0.03 = their mean. More makes rivers faster, whiter and falls wider of the "
            "rock. Of canyons and mesas the river's width tells its discharge."},
    {KEY_OF(RiverParams, foam, "foam", KEY_FLOAT), .high = 10,
     .doc = "Factor on the white water of rapids, which begins at slopes of about 0.03, and below "
            "falls; 0 = none."},
    {KEY_OF(RiverParams, shutter, "shutter", KEY_FLOAT), .high = 10, .unit = "s",
     .doc = "Time for which a picture shows the white water of falls (clouds: spray of water): 0 = "
            "clots that stand still in the air; 0.5 = silk, which clots draw on their way."},
    {KEY_OF(RiverParams, fall_height, "fall_height", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Minimum height of a step of the land over which a river falls freely; 0 = no "
            "waterfalls. Elsewhere steps become ramps of some cells."},
    {KEY_OF(RiverParams, fall_slope, "fall_slope", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .doc = "Minimum slope of such a step, over two cells; 1 = 45 degrees."},
    {KEY_OF(RiverParams, fields, "fields", KEY_LIST),
     .count_offset = offsetof(RiverParams, field_count), .count = 100, .table = &guide_field_table,
     .doc = "Guide vector fields that steer the rivers' growth, summed with their weights."},
    {KEY_OF(RiverParams, field_weight, "field_weight", KEY_FLOAT), .low = -1000, .high = 1000,
     .doc = "Weight of the fields relative to the attractors' pull."},
    {0},
};

static bool check_rivers(const Mapping *mapping, void *params)
{
    return check_source(mapping, &((const RiverParams *)params)->source);
}

static const Table RIVER_TABLE = {
    .name = "rivers",
    .doc = "The network of rivers, an out-tree from each outlet. Each root in a file is an outlet, "
           "and so is the point nearest to the border of each connected drawing in an image; a "
           "river leads from there straight to the border.",
    .size = sizeof(RiverParams),
    .keys = RIVER_KEYS,
    .check = check_rivers};

// ---- ridges

static const Key START_KEYS[] = {
    {KEY_OF(RidgeStart, at, "at", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2, .low = -0.5,
     .high = 0.5, .unit = "sizes",
     .doc = "Position: x and z as fractions of the terrain's size; [0, 0] = the centre."},
    {0},
};

static const Table START_TABLE = {.name = "ridge_start",
                                  .doc = "A summit from which ridges grow.",
                                  .size = sizeof(RidgeStart),
                                  .keys = START_KEYS};

static const Key STOP_KEYS[] = {
    {KEY_OF(LiftStop, distance, "distance", KEY_FLOAT), .flags = KEY_REQUIRED, .high = 1,
     .doc = "Distance from the ridge, as a fraction of the band's half-width there."},
    {KEY_OF(LiftStop, height, "height", KEY_FLOAT), .flags = KEY_REQUIRED, .low = -1, .high = 1,
     .doc = "Lift at this distance, as a fraction of the relief and of the band's share of it."},
    {0},
};

static const Table STOP_TABLE = {.name = "lift_stop",
                                 .doc = "A point of the lift's curve.",
                                 .size = sizeof(LiftStop),
                                 .keys = STOP_KEYS};

static const Key RIDGE_KEYS[] = {
    SOURCE_ROWS(RidgeParams, "ridges"),
    {KEY_OF(RidgeParams, starts, "starts", KEY_LIST),
     .count_offset = offsetof(RidgeParams, start_count), .count = 1000, .table = &START_TABLE,
     .doc = "Summits from which ridges grow; none = one in the centre."},
    {KEY_OF(RidgeParams, extent, "extent", KEY_VECTOR), .flags = KEY_ABOVE, .count = 2, .high = 1.5,
     .unit = "sizes", .doc = "Axes of the ellipse in which ridges grow, along x and z."},
    {KEY_OF(RidgeParams, count, "count", KEY_INT64), .low = 12, .high = 4e6,
     .doc = "Number of attractors of the finest level in the whole square, about the number of "
            "spurs."},
    {KEY_OF(RidgeParams, winding, "winding", KEY_FLOAT), .high = 1, .doc = "How far ridges wind."},
    {KEY_OF(RidgeParams, fields, "fields", KEY_LIST),
     .count_offset = offsetof(RidgeParams, field_count), .count = 100, .table = &guide_field_table,
     .doc = "Guide vector fields that steer the ridges' growth, summed with their weights."},
    {KEY_OF(RidgeParams, field_weight, "field_weight", KEY_FLOAT), .low = -1000, .high = 1000,
     .doc = "Weight of the fields relative to the attractors' pull."},
    {KEY_OF(RidgeParams, width, "width", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1, .unit = "sizes",
     .doc =
         "Half-width of the widest band, which is also the highest. The others' width and height "
         "are in proportion to the radius in the file or the width of the painted line."},
    {KEY_OF(RidgeParams, tip, "tip", KEY_FLOAT), .high = 1,
     .doc = "Width and height at the tips of ridges that are grown, or have no radii in the file, "
            "as a fraction of those at the start: from each fork a ridge falls evenly to them. 1 = "
            "all bands are alike."},
    {KEY_OF(RidgeParams, lift, "lift", KEY_LIST), .count_offset = offsetof(RidgeParams, lift_count),
     .count = LIFT_MOST_STOPS, .table = &STOP_TABLE,
     .doc = "Curve of the lift across a band, smooth and monotone between its points, 0 beyond the "
            "last; none = a sharp crest with concave flanks. Negative heights carve valleys into a "
            "plain."},
    {0},
};

static bool check_ridges(const Mapping *mapping, void *params)
{
    const RidgeParams *ridges = params;
    char key[64];
    for (int i = 1; i < ridges->lift_count; i++) {
        const LiftStop *stop = &ridges->lift[i], *last = stop - 1;
        snprintf(key, sizeof key, "lift.%d", i);
        if (stop->distance <= last->distance) {
            return mapping_fail(mapping, key,
                                " is at the distance %g, the point before it at %g; distances "
                                "must ascend",
                                (double)stop->distance, (double)last->distance);
        }
    }
    const LiftStop *signed_stop = NULL;
    for (int i = 0; i < ridges->lift_count; i++) {
        const LiftStop *stop = &ridges->lift[i];
        if (signed_stop && stop->height * signed_stop->height < 0.0f) {
            snprintf(key, sizeof key, "lift.%d", i);
            return mapping_fail(mapping, key,
                                " has the height %g, one before it %g; all heights must be "
                                "positive, or all negative",
                                (double)stop->height, (double)signed_stop->height);
        }
        signed_stop = stop->height != 0.0f ? stop : signed_stop;
    }
    return check_source(mapping, &ridges->source);
}

static const Table RIDGE_TABLE = {
    .name = "ridges",
    .doc = "Land lifted by a tree of ridges (Tanaka et al., section 5.5): a band is swept along "
           "the tree, and its colour, which is a height, tells the lift.",
    .example = "objects:\n"
               "  - name: massif\n"
               "    terrain:\n"
               "      form: ridges\n"
               "      size: 8000\n"
               "      ridges:\n"
               "        starts: [{at: [-0.2, 0]}, {at: [0.2, 0.1]}]\n"
               "        width: 0.15\n"
               "        lift: [{distance: 0, height: 1}, {distance: 0.3, height: 0.4},\n"
               "               {distance: 1, height: 0}]\n",
    .size = sizeof(RidgeParams),
    .keys = RIDGE_KEYS,
    .check = check_ridges};

// ---- map

static const Key MAP_KEYS[] = {
    {KEY_OF(MapParams, image, "image", KEY_FILE),
     .doc = "Image laid over the terrain, north up. Each colour is the altitude of the nearest "
            "colour of the scale; transparent parts are the plain. Required by form: map."},
    {KEY_OF(MapParams, colors, "colors", KEY_LIST),
     .count_offset = offsetof(MapParams, color_count), .count = 64, .table = &color_stop_table,
     .doc = "Scale of colours, from the plain to the summit; none = that of the built-in material "
            "altitude. Black and white make a grey image a map of heights."},
    {0},
};

static bool check_map(const Mapping *mapping, void *params)
{
    const MapParams *map = params;
    return check_color_stops(mapping, map->colors, map->color_count);
}

static const Table MAP_TABLE = {
    .name = "terrain_map",
    .doc = "Land lifted by the colours of a painted map (Tanaka et al., section 5.5).",
    .example = "objects:\n"
               "  - name: island\n"
               "    terrain:\n"
               "      form: map\n"
               "      relief: 900\n"
               "      map: {image: meadow.png, colors: [{at: 0, color: [0, 0, 0]}, {at: 1, color: "
               "[1, 1, 1]}]}\n",
    .size = sizeof(MapParams),
    .keys = MAP_KEYS,
    .check = check_map};

// ---- survey

static const Key SURVEY_KEYS[] = {
    {KEY_OF(SurveyParams, file, "file", KEY_FILE),
     .doc = "Raster of heights, north up, in any format that GDAL reads: GeoTIFF, HGT, ASC, DTED, "
            "IMG, VRT and others. Required by form: survey."},
    {KEY_OF(SurveyParams, band, "band", KEY_INT), .low = 1, .high = 65535,
     .doc = "Band with the heights; 1 = the first."},
    {KEY_OF(SurveyParams, center, "center", KEY_VECTOR), .count = 2, .low = -1e7, .high = 1e7,
     .unit = "m",
     .doc = "Middle of the terrain, to the east and to the south of the raster's middle; `size` "
            "tells how much is cut out."},
    {KEY_OF(SurveyParams, exaggeration, "exaggeration", KEY_FLOAT), .flags = KEY_ABOVE, .high = 100,
     .doc = "Factor on the heights; 1 = as they are."},
    {0},
};

static const Table SURVEY_TABLE = {
    .name = "survey",
    .doc = "Surveyed land: a square of a raster of heights. Its lowest point is at y = 0; degrees "
           "become metres. Its rivers are found: `rivers.count` tells how many brooks, "
           "`rivers.water` how wide they are (0 = none). `noise` adds detail finer than its cells, "
           "in proportion to the slope.",
    .example = "objects:\n"
               "  - name: range\n"
               "    terrain:\n"
               "      form: survey\n"
               "      size: 11000\n"
               "      survey: {file: heights.tif, center: [-2000, 0]}\n",
    .size = sizeof(SurveyParams),
    .keys = SURVEY_KEYS};

// ---- noise, erosion, forest

static const Key NOISE_KEYS[] = {
    {KEY_OF(TerrainNoiseParams, iterations, "iterations", KEY_INT), .high = 16,
     .doc = "Octaves of sparse convolution noise (Tanaka et al., eq. (16)); 0 = none."},
    {KEY_OF(TerrainNoiseParams, amplitude, "amplitude", KEY_FLOAT), .high = 10,
     .doc = "Standard deviation of the first octave, relative to its wavelength and to the slopes' "
            "gradient; of noise alone, relative to its wavelength."},
    {KEY_OF(TerrainNoiseParams, wavelength, "wavelength", KEY_FLOAT), .high = 10, .unit = "sizes",
     .doc = "Wavelength of the first octave; 0 = the distance between a few brooks or spurs, of "
            "noise alone 0.125."},
    {KEY_OF(TerrainNoiseParams, gain, "gain", KEY_FLOAT), .high = 1,
     .doc = "Height of each octave, as a fraction of the previous one."},
    {KEY_OF(TerrainNoiseParams, ridged, "ridged", KEY_FLOAT), .high = 1,
     .doc = "Shape of crests: 0 = round, 1 = sharp."},
    {KEY_OF(TerrainNoiseParams, warp, "warp", KEY_FLOAT), .high = 2,
     .doc = "Horizontal distortion of the slopes, as a fraction of the first wavelength."},
    {0},
};

static const Table NOISE_TABLE = {.name = "terrain_noise",
                                  .doc = "Fine erosion by noise, which fades to zero at the rivers "
                                         "and on the plain around ridges.",
                                  .size = sizeof(TerrainNoiseParams),
                                  .keys = NOISE_KEYS};

static const Key EROSION_KEYS[] = {
    {KEY_OF(TerrainErosionParams, streams, "streams", KEY_FLOAT), .high = 10,
     .doc = "How deep running water cuts gullies; 0 = not at all, 1 = clearly."},
    {KEY_OF(TerrainErosionParams, thermal, "thermal", KEY_FLOAT), .high = 10,
     .doc = "How much of the rock above the talus angle falls down; 0 = nothing, 1 = most."},
    {KEY_OF(TerrainErosionParams, talus, "talus", KEY_FLOAT), .low = 1, .high = 89,
     .unit = "degrees", .doc = "Talus angle: the steepest slope on which rubble stays."},
    {KEY_OF(TerrainErosionParams, debris, "debris", KEY_FLOAT), .high = 10,
     .doc = "How deep debris flows and rockfall cut couloirs into steep walls, with cones of scree "
            "at their feet: 0 = not at all, 1 = as in the Alps. Land of form: alps has "
            "evolution.debris for it."},
    {0},
};

static const Table EROSION_TABLE = {.name = "erosion",
                                    .doc = "Erosion of the finished height field.",
                                    .size = sizeof(TerrainErosionParams),
                                    .keys = EROSION_KEYS};

static const Key TERRACE_KEYS[] = {
    {KEY_OF(TerrainTerraceParams, count, "count", KEY_INT), .high = 1000,
     .doc = "Number of hard beds between the lowest and the highest point; 0 = none."},
    {KEY_OF(TerrainTerraceParams, strength, "strength", KEY_FLOAT), .high = 1,
     .doc = "Strength of the steps: 0 = none, 1 = full."},
    {KEY_OF(TerrainTerraceParams, sheer, "sheer", KEY_FLOAT), .high = 1,
     .doc = "Steepness of the steps: 0 = slopes, 1 = cliffs, two cells wide, over which rivers "
            "fall."},
    {0},
};

static const Table TERRACE_TABLE = {.name = "terraces",
                                    .doc = "Beds of hard rock, which form steps.",
                                    .size = sizeof(TerrainTerraceParams),
                                    .keys = TERRACE_KEYS};

static const Key TILE_KEYS[] = {
    {KEY_OF(TerrainTileParams, count, "count", KEY_INT), .high = TILE_MOST_COUNT,
     .doc = "Tiles a side of the world, a power of two; 0 = none."},
    {KEY_OF(TerrainTileParams, cells, "cells", KEY_INT), .low = TILE_LEAST_CELLS,
     .high = TILE_MOST_CELLS,
     .doc =
         "Cells a side of a tile, a power of two. All tiles together need at least as many cells "
         "as the terrain's resolution."},
    {KEY_OF(TerrainTileParams, detail, "detail", KEY_FLOAT), .high = 2,
     .doc = "Roughness and gullies finer than the terrain's resolution: 0 = none, 1 = natural."},
    {KEY_OF(TerrainTileParams, drawn, "drawn", KEY_BOOL),
     .doc = "Draw the land of its tiles, which meet without cracks: the tile below the camera with "
            "all its cells, farther ones with half, a quarter, ... of them, down to 2, so that no "
            "cell is larger than 8 mesh_error of its distance. The land beyond the square is of "
            "tiles, too, and all of it lies on the Earth's curve. Tiles with rivers or lakes have "
            "at least the terrain's own cells, with beds and shores of as fine ground. Rivers, "
            "lakes and waterfalls go on beyond the square, these the coarser the farther and "
            "without what clouds show of them; so do things scattered over the terrain and its "
            "forest, if their keys `beyond` tell so. Of forms "
            "braided, meander, delta and coast the square alone is of tiles, on a flat Earth, and "
            "ends at the terrain's own samples, where the land around it begins as without tiles. "
            "Not as a map."},
    {0},
};

static const Table TILE_TABLE = {
    .name = "terrain_tiles",
    .doc =
        "Tiles of finer ground, each made alone by ramify grow --tile; neighbours share the "
        "samples "
        "at their border, with the same bits. The terrain itself is made once, coarse and whole.",
    .example = "objects:\n"
               "  - name: world\n"
               "    terrain:\n"
               "      form: hills\n"
               "      size: 16000\n"
               "      tiles: {count: 64, cells: 512}\n"
               "      beyond: 2\n",
    .size = sizeof(TerrainTileParams),
    .keys = TILE_KEYS};

static const EnumName FORM_NAMES[] = {
    {"rivers", TERRAIN_RIVERS},   {"ridges", TERRAIN_RIDGES},   {"map", TERRAIN_MAP},
    {"noise", TERRAIN_NOISE},     {"survey", TERRAIN_SURVEY},   {"canyon", TERRAIN_CANYON},
    {"mesas", TERRAIN_MESAS},     {"alps", TERRAIN_ALPS},       {"volcano", TERRAIN_VOLCANO},
    {"dunes", TERRAIN_DUNES},     {"hills", TERRAIN_HILLS},     {"badlands", TERRAIN_BADLANDS},
    {"coast", TERRAIN_COAST},     {"braided", TERRAIN_BRAIDED}, {"karst", TERRAIN_KARST},
    {"meander", TERRAIN_MEANDER}, {"delta", TERRAIN_DELTA},     {0}};

static const EnumName SHOW_NAMES[] = {
    {"land", SHOW_LAND}, {"map", SHOW_MAP}, {"tree", SHOW_TREE}, {0}};

static const Key TERRAIN_KEYS[] = {
    {KEY_OF(TerrainParams, form, "form", KEY_ENUM), .names = FORM_NAMES,
     .doc =
         "Source of the heights. rivers: valleys along a tree of rivers; ridges: land lifted "
         "along a tree of ridges; map: land lifted by the colours of an image; noise: noise alone, "
         "on a plane; survey: a raster of surveyed heights; canyon: a plateau of beds that a river "
         "has cut; mesas: what is left of such a plateau; alps: a rising block, cut by rivers and "
         "worn by glaciers; volcano: tephra and lava about a vent; dunes: sand that the wind "
         "carries over a plain; hills: rounded land under creeping soil, which streams cut; "
         "badlands: bare beds that rills and gullies cut, with washes between; coast: "
         "cliffs, shore platforms, stacks and beaches that waves make; braided: a river in many "
         "threads on its plain of gravel, in a valley; karst: towers and cones of limestone that "
         "water has dissolved; meander: a river that winds in its floodplain, with point "
         "bars and oxbow lakes; delta: a river that enters a shallow sea and parts into channels "
         "between islands of marsh."},
    {KEY_OF(TerrainParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the terrain, at the height of the outlets."},
    {KEY_OF(TerrainParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6, .unit = "m",
     .doc = "Side length of the square; all else scales with it."},
    {KEY_OF(TerrainParams, relief, "relief", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc =
         "Height of the highest valley slopes above the outlets, of the highest ridge above "
         "the plain, or of the plateau above the river; 0 = natural slopes, of a canyon 0.09, "
         "of mesas, hills and coasts 0.04, of karst 0.05, of meander 0.03, of braided and badlands "
         "0.1, of alps 0.16 and of a "
         "volcano 0.13 of the size. Not of noise alone, surveys or dunes."},
    {KEY_OF(TerrainParams, resolution, "resolution", KEY_INT), .low = 16, .high = 8192,
     .doc = "Cells per side, a power of two; it changes the detail, not the form."},
    {KEY_OF(TerrainParams, water_level, "water_level", KEY_FLOAT), .high = 1,
     .doc = "Level of a lake or the sea, as a fraction of the relief; 0 = none."},
    {KEY_OF(TerrainParams, uplift, "uplift", KEY_GROUP), .table = &UPLIFT_TABLE,
     .doc = "Uplift of the land between rivers: high uplift makes mountains. Of form: badlands the "
            "strokes alone: high ones leave buttes, negative ones wide washes."},
    {KEY_OF(TerrainParams, rivers, "rivers", KEY_GROUP), .table = &RIVER_TABLE,
     .doc = "Rivers, which shape the land of form: rivers."},
    {KEY_OF(TerrainParams, ridges, "ridges", KEY_GROUP), .table = &RIDGE_TABLE,
     .doc = "Ridges, which lift the land of form: ridges."},
    {KEY_OF(TerrainParams, map, "map", KEY_GROUP), .table = &MAP_TABLE,
     .doc = "Painted map, which lifts the land of form: map."},
    {KEY_OF(TerrainParams, survey, "survey", KEY_GROUP), .table = &SURVEY_TABLE,
     .doc = "Surveyed heights, the land of form: survey."},
    {KEY_OF(TerrainParams, noise, "noise", KEY_GROUP), .table = &NOISE_TABLE,
     .doc = "Fine erosion by sparse convolution noise."},
    {KEY_OF(TerrainParams, erosion, "erosion", KEY_GROUP), .table = &EROSION_TABLE,
     .doc = "Erosion by streams and falling rock."},
    {KEY_OF(TerrainParams, terraces, "terraces", KEY_GROUP), .table = &TERRACE_TABLE,
     .doc = "Beds of hard rock, which form steps."},
    {KEY_OF(TerrainParams, forest, "forest", KEY_GROUP), .table = &terrain_forest_table,
     .doc = "Conifers on the slopes."},
    {KEY_OF(TerrainParams, lakes, "lakes", KEY_GROUP), .table = &terrain_lake_table,
     .doc = "Lakes at their spill levels."},
    {KEY_OF(TerrainParams, strata, "strata", KEY_GROUP), .table = &strata_table,
     .doc = "Beds of rock, which the erosion of landforms obeys and the pattern strata shows."},
    {KEY_OF(TerrainParams, joints, "joints", KEY_GROUP), .table = &joint_table,
     .doc = "Joints along which steep rock breaks into buttresses, corners and gullies."},
    {KEY_OF(TerrainParams, canyon, "canyon", KEY_GROUP), .table = &canyon_table,
     .doc = "Canyon, of form: canyon."},
    {KEY_OF(TerrainParams, mesas, "mesas", KEY_GROUP), .table = &mesa_table,
     .doc = "Mesas and buttes, of form: mesas."},
    {KEY_OF(TerrainParams, alps, "alps", KEY_GROUP), .table = &alps_table,
     .doc = "Mountains worn by ice, of form: alps."},
    {KEY_OF(TerrainParams, volcano, "volcano", KEY_GROUP), .table = &volcano_table,
     .doc = "Stratovolcano, of form: volcano."},
    {KEY_OF(TerrainParams, dunes, "dunes", KEY_GROUP), .table = &dune_table,
     .doc = "Dunes, of form: dunes."},
    {KEY_OF(TerrainParams, hills, "hills", KEY_GROUP), .table = &hill_table,
     .doc = "Rounded hills, of form: hills."},
    {KEY_OF(TerrainParams, badlands, "badlands", KEY_GROUP), .table = &badland_table,
     .doc = "Badlands, of form: badlands."},
    {KEY_OF(TerrainParams, coast, "coast", KEY_GROUP), .table = &coast_table,
     .doc = "Coast that waves cut, of form: coast."},
    {KEY_OF(TerrainParams, braided, "braided", KEY_GROUP), .table = &braided_table,
     .doc = "Braided river, of form: braided."},
    {KEY_OF(TerrainParams, karst, "karst", KEY_GROUP), .table = &karst_table,
     .doc = "Tower karst, of form: karst."},
    {KEY_OF(TerrainParams, meander, "meander", KEY_GROUP), .table = &meander_table,
     .doc = "Meandering river, of form: meander."},
    {KEY_OF(TerrainParams, delta, "delta", KEY_GROUP), .table = &delta_table,
     .doc = "River delta, of form: delta."},
    {KEY_OF(TerrainParams, evolution, "evolution", KEY_GROUP), .table = &evolution_table,
     .doc = "Processes that make form: canyon, mesas, alps, volcano, hills, badlands, "
            "coast and karst."},
    {KEY_OF(TerrainParams, tiles, "tiles", KEY_GROUP), .table = &TILE_TABLE,
     .doc = "Tiles of finer ground, for ramify grow --tile."},
    {KEY_OF(TerrainParams, beyond, "beyond", KEY_INT), .high = TERRAIN_MOST_BEYOND,
     .doc = "Rings of mirrored copies around the square (of dunes: of copies as they are), so that "
            "the "
            "land goes on to the horizon; 0 = none. They are seen, not stood on."},
    {KEY_OF(TerrainParams, show, "show", KEY_ENUM), .names = SHOW_NAMES,
     .doc = "What is drawn. land: the land with its water and forest; map: the flat plane with the "
            "land's altitudes, for a material of the pattern altitude; tree: the plane and the "
            "lines of the tree."},
    {KEY_OF(TerrainParams, mesh_error, "mesh_error", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1,
     .doc = "Maximum error of the mesh, as a fraction of the distance to the camera."},
    {0},
};

static void terrain_defaults(void *out)
{
    *(TerrainParams *)out = terrain_params_default();
}

static bool check_tiles(const Mapping *mapping, const TerrainParams *terrain)
{
    const TerrainTileParams *tiles = &terrain->tiles;
    int resolution = terrain->resolution;
    if (tiles->drawn && tiles->count == 0) {
        return mapping_fail(mapping, "tiles.drawn",
                            " is true, but tiles.count is 0; give a number of tiles, such as 16");
    }
    if (tiles->drawn && tiles->count > resolution) {
        return mapping_fail(mapping, "tiles.drawn",
                            " is true; that needs at most as many tiles a side as the terrain has "
                            "cells, %d, not %d",
                            resolution, tiles->count);
    }
    if (tiles->drawn && !terrain_can_be_tiled(terrain)) {
        return mapping_fail(mapping, "tiles.drawn",
                            " is true; a map (show: map or tree) is flat and is not drawn of "
                            "tiles");
    }
    if ((tiles->count & (tiles->count - 1)) != 0) {
        return mapping_fail(mapping, "tiles.count", " is %d; it must be a power of two, such as 64",
                            tiles->count);
    }
    if ((tiles->cells & (tiles->cells - 1)) != 0) {
        return mapping_fail(mapping, "tiles.cells",
                            " is %d; it must be a power of two, such as 512", tiles->cells);
    }
    int64_t all = (int64_t)tiles->count * tiles->cells;
    return tiles->count == 0 || all >= resolution ||
           mapping_fail(mapping, "tiles.count",
                        " is %d; %d tiles of %d cells are coarser than the terrain's %d cells",
                        tiles->count, tiles->count, tiles->cells, resolution);
}

static bool check_forest(const Mapping *mapping, const TerrainParams *terrain)
{
    int rings = terrain->forest.beyond;
    if (rings > 0 && terrain->form == TERRAIN_DELTA) {
        return mapping_fail(mapping, "forest.beyond",
                            " is %d; around a delta there are no copies of the square", rings);
    }
    return rings <= terrain->beyond ||
           mapping_fail(mapping, "forest.beyond",
                        " is %d, but the terrain's own beyond is %d; that must be as much at least",
                        rings, terrain->beyond);
}

static bool check_terrain(const Mapping *mapping, void *params)
{
    const TerrainParams *terrain = params;
    int cells = terrain->resolution;
    if (terrain->form == TERRAIN_MAP && !terrain->map.image) {
        return mapping_fail(mapping, "map.image", " is missing; form: map needs an image");
    }
    if (terrain->form == TERRAIN_SURVEY && !terrain->survey.file) {
        return mapping_fail(mapping, "survey.file", " is missing; form: survey needs a raster");
    }
    double cell = (double)terrain->size / cells, width = (double)terrain->meander.width;
    if (terrain->form == TERRAIN_MEANDER && width > 0.0 && width < cell) {
        return mapping_fail(mapping, "meander.width",
                            " is %g m, less than a cell of the terrain, %g m; a river must be at "
                            "least a cell wide",
                            width, cell);
    }
    double river = (double)terrain->delta.width, most = (double)terrain->size * DELTA_INLETS;
    if (terrain->form == TERRAIN_DELTA && river > 0.0 &&
        (river < most / DELTA_MOST_CELLS || river > most / DELTA_LEAST_CELLS)) {
        return mapping_fail(mapping, "delta.width",
                            " is %g m; in a terrain of %g m a river that builds a delta is %g to "
                            "%g m wide",
                            river, (double)terrain->size, most / DELTA_MOST_CELLS,
                            most / DELTA_LEAST_CELLS);
    }
    if (terrain->lakes.count > 0 && terrain->water_level > 0.0f) {
        return mapping_fail(mapping, "lakes.count",
                            " is %d, and water_level %g; land has lakes at their own levels or one "
                            "water level",
                            terrain->lakes.count, (double)terrain->water_level);
    }
    if (terrain->lakes.count > 0 && !terrain_holds_lakes(terrain)) {
        return mapping_fail(mapping, "lakes.count",
                            " is %d; forms braided, meander, delta, dunes and coast have no lakes",
                            terrain->lakes.count);
    }
    int evolved = terrain->evolution.cells;
    if ((evolved & (evolved - 1)) != 0) {
        return mapping_fail(mapping, "evolution.cells",
                            " is %d; it must be a power of two, such as 1024", evolved);
    }
    return check_tiles(mapping, terrain) && check_forest(mapping, terrain) &&
           ((cells & (cells - 1)) == 0 ||
            mapping_fail(mapping, "resolution", " is %d; it must be a power of two, such as 1024",
                         cells));
}

const Table terrain_table = {
    .name = "terrain",
    .doc = "Mountains, valleys and rivers (Tanaka et al., section 5.5). A tree of rivers or of "
           "ridges grows first, or is read from a file or a picture; the land follows from it. "
           "Landforms come from a plateau that rivers cut and slopes wear. Materials: mountain "
           "(strata "
           "where there are beds), lake, node.",
    .example =
        "objects:\n"
        "  - name: range\n"
        "    terrain:\n"
        "      size: 8000\n"
        "      uplift: {base: 0.3, strokes: [{from: [-0.3, 0], to: [0.3, 0.1], strength: 3}]}\n"
        "      rivers: {outlets: 3, side: south}\n",
    .size = sizeof(TerrainParams),
    .keys = TERRAIN_KEYS,
    .defaults = terrain_defaults,
    .check = check_terrain};
