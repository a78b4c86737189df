// The terrain: uplift, rivers, noise, erosion, forest.
#include "objects/common/tables.h"
#include "objects/terrain/terrain.h"

static const Key STROKE_KEYS[] = {
    {KEY_OF(UpliftStroke, from, "from", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2,
     .unit = "sizes",
     .doc = "Where the stroke begins: x and z as shares of the terrain's size, "
            "[0, 0] in the middle, [-0.5, -0.5] in the north-west."},
    {KEY_OF(UpliftStroke, to, "to", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2, .unit = "sizes",
     .doc = "Where it ends; the same place makes a round spot."},
    {KEY_OF(UpliftStroke, radius, "radius", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "sizes", .doc = "Distance at which it has faded away."},
    {KEY_OF(UpliftStroke, strength, "strength", KEY_FLOAT), .low = -100, .high = 100,
     .doc = "Added to the uplift in its middle; negative sinks the land."},
    {0},
};

static void stroke_defaults(void *out)
{
    *(UpliftStroke *)out = (UpliftStroke){.radius = 0.25f, .strength = 2.0f};
}

static const Table STROKE_TABLE = {.name = "uplift_stroke",
                                   .doc = "A stroke of the brush that raises land.",
                                   .size = sizeof(UpliftStroke),
                                   .keys = STROKE_KEYS,
                                   .defaults = stroke_defaults};

static const Key UPLIFT_KEYS[] = {
    {KEY_OF(UpliftParams, base, "base", KEY_FLOAT), .high = 100,
     .doc = "Uplift where nothing is painted."},
    {KEY_OF(UpliftParams, noise, "noise", KEY_FLOAT), .high = 1,
     .doc = "How far it wavers from place to place."},
    {KEY_OF(UpliftParams, strokes, "strokes", KEY_LIST),
     .count_offset = offsetof(UpliftParams, stroke_count), .count = 1000, .table = &STROKE_TABLE,
     .doc = "Strokes of the brush."},
    {KEY_OF(UpliftParams, image, "image", KEY_FILE),
     .doc = "Grey picture laid over the terrain, north up: multiplies the uplift."},
    {0},
};

static const Table UPLIFT_TABLE = {.name = "uplift",
                                   .doc = "Where the land rises: high uplift makes the mountains.",
                                   .size = sizeof(UpliftParams),
                                   .keys = UPLIFT_KEYS};

static const EnumName SIDES[] = {{"all", SIDE_ALL},     {"north", SIDE_NORTH}, {"east", SIDE_EAST},
                                 {"south", SIDE_SOUTH}, {"west", SIDE_WEST},   {0}};

static const Key RIVER_KEYS[] = {
    {KEY_OF(RiverParams, outlets, "outlets", KEY_INT), .low = 1, .high = 10000,
     .doc = "Rivers that leave the terrain."},
    {KEY_OF(RiverParams, side, "side", KEY_ENUM), .names = SIDES,
     .doc = "Border over which they leave."},
    {KEY_OF(RiverParams, count, "count", KEY_INT64), .low = 12, .high = 4e6,
     .doc = "Attractors of the finest level, about as many as brooks: few make long slopes."},
    {KEY_OF(RiverParams, winding, "winding", KEY_FLOAT), .high = 1,
     .doc = "How far rivers wind: noise of their growth and the windings laid over main rivers."},
    {KEY_OF(RiverParams, gradient, "gradient", KEY_FLOAT), .high = 0.9,
     .doc = "Gradient of brooks, as a share of the slopes' gradient."},
    {KEY_OF(RiverParams, concavity, "concavity", KEY_FLOAT), .high = 2,
     .doc = "Exponent by which rivers flatten as they gather water; 0.42 in nature."},
    {KEY_OF(RiverParams, valley, "valley", KEY_FLOAT), .high = 1,
     .doc = "Half width of valley floors, as a share of the root of the drainage area."},
    {KEY_OF(RiverParams, water, "water", KEY_FLOAT), .high = 1,
     .doc =
         "Half width of the water, likewise as a share of the root of the drainage area; 0 = dry. "
         "Only rivers wider than 1.2 cells show."},
    {KEY_OF(RiverParams, fields, "fields", KEY_LIST),
     .count_offset = offsetof(RiverParams, field_count), .count = 100, .table = &guide_field_table,
     .doc = "Guide vector fields that steer the rivers' growth, summed with their weights."},
    {KEY_OF(RiverParams, field_weight, "field_weight", KEY_FLOAT), .low = -1000, .high = 1000,
     .doc = "Weight of the fields against the attractors' pull."},
    {0},
};

static const Table RIVER_TABLE = {.name = "rivers",
                                  .doc = "The out-tree of rivers.",
                                  .size = sizeof(RiverParams),
                                  .keys = RIVER_KEYS};

static const Key NOISE_KEYS[] = {
    {KEY_OF(TerrainNoiseParams, iterations, "iterations", KEY_INT), .high = 16,
     .doc = "Octaves of sparse convolution noise (Tanaka et al., eq. (16)); 0 = none."},
    {KEY_OF(TerrainNoiseParams, amplitude, "amplitude", KEY_FLOAT), .high = 10,
     .doc =
         "Height of the first octave, as a share of its wavelength and of the slopes' gradient."},
    {KEY_OF(TerrainNoiseParams, wavelength, "wavelength", KEY_FLOAT), .high = 10, .unit = "sizes",
     .doc = "Wavelength of the first octave; 0 = a few brooks apart."},
    {KEY_OF(TerrainNoiseParams, gain, "gain", KEY_FLOAT), .high = 1,
     .doc = "Height of each octave as a share of the one before."},
    {KEY_OF(TerrainNoiseParams, ridged, "ridged", KEY_FLOAT), .high = 1,
     .doc = "0 = round, 1 = with sharp crests."},
    {KEY_OF(TerrainNoiseParams, warp, "warp", KEY_FLOAT), .high = 2,
     .doc = "How far slopes are pushed about, as a share of the first wavelength."},
    {0},
};

static const Table NOISE_TABLE = {.name = "terrain_noise",
                                  .doc = "Fine erosion, fading to nothing at the rivers.",
                                  .size = sizeof(TerrainNoiseParams),
                                  .keys = NOISE_KEYS};

static const Key EROSION_KEYS[] = {
    {KEY_OF(TerrainErosionParams, streams, "streams", KEY_FLOAT), .high = 10,
     .doc = "How deep running water cuts gullies; 0 = not, 1 = well."},
    {KEY_OF(TerrainErosionParams, thermal, "thermal", KEY_FLOAT), .high = 10,
     .doc = "How much of what stands too steep falls down; 0 = nothing, 1 = most."},
    {KEY_OF(TerrainErosionParams, talus, "talus", KEY_FLOAT), .low = 1, .high = 89,
     .unit = "degrees", .doc = "Steepest slope on which rubble stays."},
    {0},
};

static const Table EROSION_TABLE = {.name = "erosion",
                                    .doc = "Erosion of the finished heights.",
                                    .size = sizeof(TerrainErosionParams),
                                    .keys = EROSION_KEYS};

static const Key TERRACE_KEYS[] = {
    {KEY_OF(TerrainTerraceParams, count, "count", KEY_INT), .high = 1000,
     .doc = "Hard beds between the lowest and the highest point; 0 = none."},
    {KEY_OF(TerrainTerraceParams, strength, "strength", KEY_FLOAT), .high = 1,
     .doc = "How far the land steps over them."},
    {0},
};

static const Table TERRACE_TABLE = {.name = "terraces",
                                    .doc = "Beds of hard rock that stand out as steps.",
                                    .size = sizeof(TerrainTerraceParams),
                                    .keys = TERRACE_KEYS};

static const Key FOREST_KEYS[] = {
    {KEY_OF(TerrainForestParams, count, "count", KEY_INT), .high = 1e7,
     .doc = "Most conifers; 0 = none. Far ones are left out first."},
    {KEY_OF(TerrainForestParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Height of the tallest."},
    {KEY_OF(TerrainForestParams, low, "low", KEY_FLOAT), .high = 1,
     .doc = "Altitude of the lowest trees, a share of the relief."},
    {KEY_OF(TerrainForestParams, high, "high", KEY_FLOAT), .high = 1,
     .doc = "Altitude of the tree line, a share of the relief."},
    {KEY_OF(TerrainForestParams, slope, "slope", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "None grow on steeper land."},
    {KEY_OF(TerrainForestParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "0 = even, 1 = woods with clearings."},
    {0},
};

static const Table FOREST_TABLE = {.name = "forest",
                                   .doc = "Conifers on the slopes.",
                                   .size = sizeof(TerrainForestParams),
                                   .keys = FOREST_KEYS};

static const Key TERRAIN_KEYS[] = {
    {KEY_OF(TerrainParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "The middle, at the height of the outlets."},
    {KEY_OF(TerrainParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6, .unit = "m",
     .doc = "Side of the square; all else follows it."},
    {KEY_OF(TerrainParams, relief, "relief", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Height of the highest valley slopes above the outlets; 0 = natural slopes."},
    {KEY_OF(TerrainParams, resolution, "resolution", KEY_INT), .low = 16, .high = 8192,
     .doc = "Cells a side, a power of two: detail, not form."},
    {KEY_OF(TerrainParams, water_level, "water_level", KEY_FLOAT), .high = 1,
     .doc = "Share of the relief under a lake or the sea; 0 = none."},
    {KEY_OF(TerrainParams, uplift, "uplift", KEY_GROUP), .table = &UPLIFT_TABLE,
     .doc = "Where the land rises."},
    {KEY_OF(TerrainParams, rivers, "rivers", KEY_GROUP), .table = &RIVER_TABLE,
     .doc = "The rivers that the land follows."},
    {KEY_OF(TerrainParams, noise, "noise", KEY_GROUP), .table = &NOISE_TABLE,
     .doc = "Fine erosion by sparse convolution noise."},
    {KEY_OF(TerrainParams, erosion, "erosion", KEY_GROUP), .table = &EROSION_TABLE,
     .doc = "Erosion by streams and falling rock."},
    {KEY_OF(TerrainParams, terraces, "terraces", KEY_GROUP), .table = &TERRACE_TABLE,
     .doc = "Steps of hard beds."},
    {KEY_OF(TerrainParams, forest, "forest", KEY_GROUP), .table = &FOREST_TABLE,
     .doc = "Conifers."},
    {KEY_OF(TerrainParams, mesh_error, "mesh_error", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1,
     .doc = "Largest error of the mesh, as a share of the distance to the camera."},
    {0},
};

static void terrain_defaults(void *out)
{
    *(TerrainParams *)out = terrain_params_default();
}

static bool check_terrain(const Mapping *mapping, void *params)
{
    int cells = ((const TerrainParams *)params)->resolution;
    return (cells & (cells - 1)) == 0 ||
           mapping_fail(mapping, "resolution", " is %d; it must be a power of two, such as 1024",
                        cells);
}

const Table terrain_table = {
    .name = "terrain",
    .doc = "Mountains, valleys and rivers (Tanaka et al., section 5.5): rivers grow first, and the "
           "land is what stands between them. Materials: mountain, lake.",
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
