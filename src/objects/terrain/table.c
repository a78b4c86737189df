// The terrain: uplift, rivers, noise, erosion, forest.
#include "objects/common/tables.h"
#include "objects/terrain/terrain.h"

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

static const EnumName SIDES[] = {{"all", SIDE_ALL},     {"north", SIDE_NORTH}, {"east", SIDE_EAST},
                                 {"south", SIDE_SOUTH}, {"west", SIDE_WEST},   {0}};

static const Key RIVER_KEYS[] = {
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
    {KEY_OF(RiverParams, fields, "fields", KEY_LIST),
     .count_offset = offsetof(RiverParams, field_count), .count = 100, .table = &guide_field_table,
     .doc = "Guide vector fields that steer the rivers' growth, summed with their weights."},
    {KEY_OF(RiverParams, field_weight, "field_weight", KEY_FLOAT), .low = -1000, .high = 1000,
     .doc = "Weight of the fields relative to the attractors' pull."},
    {0},
};

static const Table RIVER_TABLE = {.name = "rivers",
                                  .doc = "The network of rivers, an out-tree from each outlet.",
                                  .size = sizeof(RiverParams),
                                  .keys = RIVER_KEYS};

static const Key NOISE_KEYS[] = {
    {KEY_OF(TerrainNoiseParams, iterations, "iterations", KEY_INT), .high = 16,
     .doc = "Octaves of sparse convolution noise (Tanaka et al., eq. (16)); 0 = none."},
    {KEY_OF(TerrainNoiseParams, amplitude, "amplitude", KEY_FLOAT), .high = 10,
     .doc = "Height of the first octave, relative to its wavelength and to the slopes' gradient."},
    {KEY_OF(TerrainNoiseParams, wavelength, "wavelength", KEY_FLOAT), .high = 10, .unit = "sizes",
     .doc = "Wavelength of the first octave; 0 = the distance between a few brooks."},
    {KEY_OF(TerrainNoiseParams, gain, "gain", KEY_FLOAT), .high = 1,
     .doc = "Height of each octave, as a fraction of the previous one."},
    {KEY_OF(TerrainNoiseParams, ridged, "ridged", KEY_FLOAT), .high = 1,
     .doc = "Shape of crests: 0 = round, 1 = sharp."},
    {KEY_OF(TerrainNoiseParams, warp, "warp", KEY_FLOAT), .high = 2,
     .doc = "Horizontal distortion of the slopes, as a fraction of the first wavelength."},
    {0},
};

static const Table NOISE_TABLE = {.name = "terrain_noise",
                                  .doc =
                                      "Fine erosion by noise, which fades to zero at the rivers.",
                                  .size = sizeof(TerrainNoiseParams),
                                  .keys = NOISE_KEYS};

static const Key EROSION_KEYS[] = {
    {KEY_OF(TerrainErosionParams, streams, "streams", KEY_FLOAT), .high = 10,
     .doc = "How deep running water cuts gullies; 0 = not at all, 1 = clearly."},
    {KEY_OF(TerrainErosionParams, thermal, "thermal", KEY_FLOAT), .high = 10,
     .doc = "How much of the rock above the talus angle falls down; 0 = nothing, 1 = most."},
    {KEY_OF(TerrainErosionParams, talus, "talus", KEY_FLOAT), .low = 1, .high = 89,
     .unit = "degrees", .doc = "Talus angle: the steepest slope on which rubble stays."},
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
    {0},
};

static const Table TERRACE_TABLE = {.name = "terraces",
                                    .doc = "Beds of hard rock, which form steps.",
                                    .size = sizeof(TerrainTerraceParams),
                                    .keys = TERRACE_KEYS};

static const Key FOREST_KEYS[] = {
    {KEY_OF(TerrainForestParams, count, "count", KEY_INT), .high = 1e7,
     .doc = "Maximum number of conifers; 0 = none. Distant ones are omitted first."},
    {KEY_OF(TerrainForestParams, height, "height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Height of the tallest conifers."},
    {KEY_OF(TerrainForestParams, low, "low", KEY_FLOAT), .high = 1,
     .doc = "Altitude of the lowest trees, as a fraction of the relief."},
    {KEY_OF(TerrainForestParams, high, "high", KEY_FLOAT), .high = 1,
     .doc = "Altitude of the tree line, as a fraction of the relief."},
    {KEY_OF(TerrainForestParams, slope, "slope", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Steepest slope on which trees grow."},
    {KEY_OF(TerrainForestParams, clumping, "clumping", KEY_FLOAT), .high = 1,
     .doc = "Distribution: 0 = uniform, 1 = woods with clearings."},
    {0},
};

static const Table FOREST_TABLE = {.name = "forest",
                                   .doc = "Conifers on the slopes.",
                                   .size = sizeof(TerrainForestParams),
                                   .keys = FOREST_KEYS};

static const Key TERRAIN_KEYS[] = {
    {KEY_OF(TerrainParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the terrain, at the height of the outlets."},
    {KEY_OF(TerrainParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1e6, .unit = "m",
     .doc = "Side length of the square; all else scales with it."},
    {KEY_OF(TerrainParams, relief, "relief", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Height of the highest valley slopes above the outlets; 0 = natural slopes."},
    {KEY_OF(TerrainParams, resolution, "resolution", KEY_INT), .low = 16, .high = 8192,
     .doc = "Cells per side, a power of two; it changes the detail, not the form."},
    {KEY_OF(TerrainParams, water_level, "water_level", KEY_FLOAT), .high = 1,
     .doc = "Level of a lake or the sea, as a fraction of the relief; 0 = none."},
    {KEY_OF(TerrainParams, uplift, "uplift", KEY_GROUP), .table = &UPLIFT_TABLE,
     .doc = "Uplift of the land: high uplift makes mountains."},
    {KEY_OF(TerrainParams, rivers, "rivers", KEY_GROUP), .table = &RIVER_TABLE,
     .doc = "Rivers, which shape the land."},
    {KEY_OF(TerrainParams, noise, "noise", KEY_GROUP), .table = &NOISE_TABLE,
     .doc = "Fine erosion by sparse convolution noise."},
    {KEY_OF(TerrainParams, erosion, "erosion", KEY_GROUP), .table = &EROSION_TABLE,
     .doc = "Erosion by streams and falling rock."},
    {KEY_OF(TerrainParams, terraces, "terraces", KEY_GROUP), .table = &TERRACE_TABLE,
     .doc = "Beds of hard rock, which form steps."},
    {KEY_OF(TerrainParams, forest, "forest", KEY_GROUP), .table = &FOREST_TABLE,
     .doc = "Conifers on the slopes."},
    {KEY_OF(TerrainParams, mesh_error, "mesh_error", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1,
     .doc = "Maximum error of the mesh, as a fraction of the distance to the camera."},
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
    .doc = "Mountains, valleys and rivers (Tanaka et al., section 5.5). The rivers grow first; the "
           "land between them follows. Materials: mountain, lake.",
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
