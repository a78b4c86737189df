// The keys of landforms: beds of rock, canyon, mesas, and the processes that make them.
#include "config/table.h"
#include "objects/terrain/landform.h"

static const Key BED_KEYS[] = {
    {KEY_OF(StrataBed, thickness, "thickness", KEY_FLOAT), .flags = KEY_REQUIRED | KEY_ABOVE,
     .high = 1e5, .unit = "m", .doc = "Vertical thickness."},
    {KEY_OF(StrataBed, hardness, "hardness", KEY_FLOAT), .high = 1,
     .doc = "0 = clay, which wears away first; 1 = the hardest rock, which stands as a cliff."},
    {KEY_OF(StrataBed, slope, "slope", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "Steepest face that stands; 0 = by the hardness, from 32 to 80."},
    {KEY_OF(StrataBed, color, "color", KEY_COLOR), .high = 1, .doc = "Reflectance."},
    {KEY_OF(StrataBed, lamina, "lamina", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Mean thickness of the layers within the bed, of which the pattern badlands shows a "
            "seventh; 0 = none."},
    {KEY_OF(StrataBed, ledge, "ledge", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Pattern badlands: how far the bed stands out of the wall as a ledge, broken along its "
            "strike, with chips of it below."},
    {0},
};

static void bed_defaults(void *out)
{
    *(StrataBed *)out =
        (StrataBed){.hardness = 0.5f, .color = {0.42f, 0.22f, 0.13f}, .lamina = 3.0f};
}

static const Table BED_TABLE = {.name = "bed",
                                .doc = "A bed of rock.",
                                .size = sizeof(StrataBed),
                                .keys = BED_KEYS,
                                .defaults = bed_defaults};

static const Key FAULT_KEYS[] = {
    {KEY_OF(StrataFault, at, "at", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 2, .unit = "sizes",
     .doc = "A place on the fault: x and z as fractions of the terrain's size."},
    {KEY_OF(StrataFault, azimuth, "azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Direction in which the fault runs, clockwise from north (-z)."},
    {KEY_OF(StrataFault, drop, "drop", KEY_FLOAT), .flags = KEY_REQUIRED, .low = -1e5, .high = 1e5,
     .unit = "m", .doc = "How much lower beds lie on its right, seen along the azimuth."},
    {0},
};

static const Table FAULT_TABLE = {
    .name = "fault", .doc = "A vertical fault.", .size = sizeof(StrataFault), .keys = FAULT_KEYS};

static const Key FOLD_KEYS[] = {
    {KEY_OF(StrataFolds, wavelength, "wavelength", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Distance from crest to crest; 0 = no folds."},
    {KEY_OF(StrataFolds, amplitude, "amplitude", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Height of crests above the mean."},
    {KEY_OF(StrataFolds, azimuth, "azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Direction across the crests, clockwise from north."},
    {0},
};

static const Table FOLD_TABLE = {.name = "folds",
                                 .doc = "Folds of the beds, all alike.",
                                 .size = sizeof(StrataFolds),
                                 .keys = FOLD_KEYS};

static const Key STRATA_KEYS[] = {
    {KEY_OF(StrataParams, beds, "beds", KEY_LIST),
     .count_offset = offsetof(StrataParams, bed_count), .count = STRATA_MOST_BEDS,
     .table = &BED_TABLE,
     .doc = "Beds from the top down. The first goes on upward and the last downward; none = the "
            "landform's own, in proportion to its relief."},
    {KEY_OF(StrataParams, top, "top", KEY_FLOAT), .low = -1e5, .high = 1e5, .unit = "m",
     .doc = "Height of the top of the first bed in the middle of the terrain, above its position; "
            "0 = the relief."},
    {KEY_OF(StrataParams, dip, "dip", KEY_FLOAT), .high = 89, .unit = "degrees",
     .doc = "How steeply the beds dip."},
    {KEY_OF(StrataParams, dip_azimuth, "dip_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Direction in which they dip, clockwise from north (-z)."},
    {KEY_OF(StrataParams, folds, "folds", KEY_GROUP), .table = &FOLD_TABLE, .doc = "Folds."},
    {KEY_OF(StrataParams, faults, "faults", KEY_LIST),
     .count_offset = offsetof(StrataParams, fault_count), .count = STRATA_MOST_FAULTS,
     .table = &FAULT_TABLE, .doc = "Vertical faults."},
    {0},
};

const Table strata_table = {
    .name = "strata",
    .doc = "Beds of rock. Erosion obeys them: hard beds stand as cliffs, soft ones weather back to "
           "slopes and benches. A material of the pattern strata shows their colours.",
    .example = "objects:\n"
               "  - name: mesa\n"
               "    terrain:\n"
               "      form: mesas\n"
               "      relief: 300\n"
               "      strata:\n"
               "        dip: 1\n"
               "        beds:\n"
               "          - {thickness: 120, hardness: 0.9, color: [0.48, 0.22, 0.12]}\n"
               "          - {thickness: 170, hardness: 0.1, color: [0.38, 0.14, 0.08]}\n"
               "          - {thickness: 100, hardness: 0.9, color: [0.45, 0.24, 0.15]}\n",
    .size = sizeof(StrataParams),
    .keys = STRATA_KEYS};

static const Key CANYON_KEYS[] = {
    {KEY_OF(CanyonParams, width, "width", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Mean width from rim to rim, side canyons left out; 0 = six times the relief. The "
            "steepest faces that the beds allow set a lower limit."},
    {KEY_OF(CanyonParams, sinuosity, "sinuosity", KEY_FLOAT), .low = 1, .high = 3.5,
     .doc = "Length of the river relative to that of its valley; 1 = straight."},
    {KEY_OF(CanyonParams, meander, "meander", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .unit = "sizes", .doc = "Wavelength of the river's bends along its valley."},
    {KEY_OF(CanyonParams, river, "river", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Width of the water; 0 = dry."},
    {KEY_OF(CanyonParams, side_canyons, "side_canyons", KEY_FLOAT), .high = 10,
     .doc = "How far side canyons reach back into the plateau."},
    {0},
};

const Table canyon_table = {.name = "canyon",
                            .doc =
                                "A river that has cut a plateau of beds. The relief is the depth.",
                            .example = "objects:\n"
                                       "  - name: canyon\n"
                                       "    terrain:\n"
                                       "      form: canyon\n"
                                       "      size: 8000\n"
                                       "      relief: 500\n"
                                       "      canyon: {width: 1800, sinuosity: 1.8}\n",
                            .size = sizeof(CanyonParams),
                            .keys = CANYON_KEYS};

static const Key MESA_KEYS[] = {
    {KEY_OF(MesaParams, streams, "streams", KEY_INT), .low = 2, .high = 64,
     .doc = "Number of streams across the plain between the mesas."},
    {KEY_OF(MesaParams, remaining, "remaining", KEY_FLOAT), .low = 0.005, .high = 0.9,
     .doc = "About the fraction of the plateau that still stands: many mesas at 0.3, a few buttes "
            "at 0.03."},
    {0},
};

const Table mesa_table = {.name = "mesas",
                          .doc = "A plateau of which mesas and buttes are left. The relief "
                                 "is their height above the plain.",
                          .size = sizeof(MesaParams),
                          .keys = MESA_KEYS};

static const Key ALPS_KEYS[] = {
    {KEY_OF(AlpsParams, ice, "ice", KEY_FLOAT), .high = 4,
     .doc = "How much glaciers have worn: 0 = rivers alone; 1 = as the ice ages did."},
    {KEY_OF(AlpsParams, ice_line, "ice_line", KEY_FLOAT), .high = 1,
     .doc = "Altitude of the glaciers' equilibrium line, as a fraction of the relief: low = ice "
            "streams in all valleys, high = cirques alone."},
    {KEY_OF(AlpsParams, age, "age", KEY_FLOAT), .high = 1,
     .doc = "0 = young, with sharp ridges; 1 = old, rounded hills under soil."},
    {KEY_OF(AlpsParams, outlets, "outlets", KEY_INT), .low = 1, .high = 64,
     .doc = "Number of rivers that leave over the border."},
    {KEY_OF(AlpsParams, wind, "wind", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Where the wind comes from, clockwise from north (-z): snow drifts to the lee."},
    {0},
};

const Table alps_table = {.name = "alps",
                          .doc = "A block that rises, cut by rivers and worn by glaciers. The "
                                 "relief is about its height.",
                          .example = "objects:\n"
                                     "  - name: range\n"
                                     "    terrain:\n"
                                     "      form: alps\n"
                                     "      size: 14000\n"
                                     "      relief: 2200\n"
                                     "      alps: {ice: 1, ice_line: 0.4}\n",
                          .size = sizeof(AlpsParams),
                          .keys = ALPS_KEYS};

static const EnumName VOLCANO_NAMES[] = {{"strato", VOLCANO_STRATO}, {"ash", VOLCANO_ASH}, {0}};

enum { STRATO_ONLY = 1u << VOLCANO_STRATO };
static const Key VOLCANO_KEYS[] = {
    {KEY_OF(VolcanoParams, kind, "kind", KEY_ENUM), .names = VOLCANO_NAMES,
     .doc = "strato: tephra and lava in turn, with concave flanks; ash: a cone of one vent's ash "
            "and scoria at their angle of repose, with straight flanks, without lava."},
    {KEY_OF(VolcanoParams, at, "at", KEY_VECTOR), .count = 2, .low = -0.4, .high = 0.4,
     .unit = "sizes",
     .doc = "The middle of the crater: x and z as fractions of the terrain's size."},
    {KEY_OF(VolcanoParams, crater, "crater", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Width of the crater from rim to rim; 0 = 0.26 of the relief."},
    {KEY_OF(VolcanoParams, breach, "breach", KEY_FLOAT), .high = 1,
     .doc = "How much of the cone has slid off: 0 = nothing, the rim is closed; 1 = a horseshoe "
            "that is open down to the flank. A debris avalanche lies below it."},
    {KEY_OF(VolcanoParams, breach_azimuth, "breach_azimuth", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Direction in which it slid, clockwise from north (-z)."},
    {KEY_OF(VolcanoParams, caldera, "caldera", KEY_FLOAT), .high = 1e5, .unit = "m",
     .kinds = STRATO_ONLY,
     .doc = "Radius of a caldera, in which a smaller cone has grown; 0 = none."},
    {KEY_OF(VolcanoParams, flows, "flows", KEY_INT), .high = 200, .kinds = STRATO_ONLY,
     .doc = "Number of young lava flows, from the rim, the flanks and the feet of the cones."},
    {KEY_OF(VolcanoParams, cones, "cones", KEY_INT), .high = VOLCANO_MOST_CONES,
     .kinds = STRATO_ONLY, .doc = "Number of scoria cones on the flanks, most along two fissures."},
    {KEY_OF(VolcanoParams, wind, "wind", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Where the wind comes from, clockwise from north (-z): tephra falls and snow drifts to "
            "the lee."},
    {KEY_OF(VolcanoParams, age, "age", KEY_FLOAT), .high = 1,
     .doc = "0 = active, smooth under fresh tephra; 1 = long extinct, cut by deep gullies."},
    {KEY_OF(VolcanoParams, barrancos, "barrancos", KEY_INT), .high = VOLCANO_MOST_BARRANCOS,
     .doc = "Number of barrancos about the cone at half its height: gullies that radiate from the "
            "rim, with ribs as sharp as a knife between them, and as deep as the age says, at 1 "
            "as deep as they stand apart; more begin farther down. 0 = gullies as rain finds its "
            "way."},
    {0},
};

const Table volcano_table = {
    .name = "volcano",
    .doc = "A volcano: layers of tephra, flows of lava, gullies, or a cone of ash. The relief is "
           "the height of its rim above the plain.",
    .example = "objects:\n"
               "  - name: cone\n"
               "    terrain:\n"
               "      form: volcano\n"
               "      size: 16000\n"
               "      relief: 2000\n"
               "      volcano: {breach: 0.6, breach_azimuth: 20, cones: 8}\n",
    .size = sizeof(VolcanoParams),
    .keys = VOLCANO_KEYS,
    .kind_key = "kind",
};
static const EnumName DUNE_NAMES[] = {{"barchan", DUNE_BARCHAN},
                                      {"transverse", DUNE_TRANSVERSE},
                                      {"linear", DUNE_LINEAR},
                                      {"star", DUNE_STAR},
                                      {0}};

static const Key DUNE_KEYS[] = {
    {KEY_OF(DuneParams, kind, "kind", KEY_ENUM), .names = DUNE_NAMES,
     .doc = "Winds and supply of sand. barchan: one wind, little sand on bare ground; transverse: "
            "one wind, much sand; linear: two winds at an obtuse angle in turn; star: winds from "
            "all around in turn."},
    {KEY_OF(DuneParams, wind, "wind", KEY_FLOAT), .low = -360, .high = 360, .unit = "degrees",
     .doc = "Where the wind comes from, clockwise from north (-z); of linear dunes the mean of "
            "both winds."},
    {KEY_OF(DuneParams, spread, "spread", KEY_FLOAT), .low = 20, .high = 170, .unit = "degrees",
     .doc = "Angle between the two winds of linear dunes."},
    {KEY_OF(DuneParams, spacing, "spacing", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Approximate distance from crest to crest, which sets the dunes' size too; 0 = a "
            "quarter of the terrain's size. A quarter to an eighth of the size suits most."},
    {KEY_OF(DuneParams, sand, "sand", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Mean depth of the sand; 0 = by kind and spacing."},
    {KEY_OF(DuneParams, age, "age", KEY_FLOAT), .flags = KEY_ABOVE, .high = 20,
     .doc = "How long the wind has blown: 1 = until dunes have slip faces; more = fewer, larger "
            "dunes."},
    {0},
};

const Table dune_table = {.name = "dunes",
                          .doc = "Sand that the wind carries. The square repeats without a seam.",
                          .example = "objects:\n"
                                     "  - name: erg\n"
                                     "    terrain:\n"
                                     "      form: dunes\n"
                                     "      size: 1200\n"
                                     "      beyond: 2\n"
                                     "      dunes: {kind: transverse, wind: 250, spacing: 250}\n",
                          .size = sizeof(DuneParams),
                          .keys = DUNE_KEYS};

static const Key HILL_KEYS[] = {
    {KEY_OF(HillParams, spacing, "spacing", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Approximate distance from one small valley to the next; 0 = a tenth of the terrain's "
            "size. Close valleys need soil that creeps slowly, wide ones soil that creeps fast."},
    {KEY_OF(HillParams, outlets, "outlets", KEY_INT), .low = 1, .high = 64,
     .doc = "Number of streams that leave over the border."},
    {KEY_OF(HillParams, rills, "rills", KEY_FLOAT), .high = 2,
     .doc =
         "Rills, finer than the valleys, that storm water has cut into the slopes: 0 = none, under "
         "grass; 1 = deep ones, in bare ground. They need cells of a few per cent of the spacing."},
    {0},
};

const Table hill_table = {.name = "hills",
                          .doc =
                              "Convex hills under soil between streams. The relief is the height "
                              "of the highest above the outlets.",
                          .example = "objects:\n"
                                     "  - name: downs\n"
                                     "    terrain:\n"
                                     "      form: hills\n"
                                     "      size: 4000\n"
                                     "      relief: 160\n"
                                     "      hills: {spacing: 350}\n",
                          .size = sizeof(HillParams),
                          .keys = HILL_KEYS};

static const Key BADLAND_KEYS[] = {
    {KEY_OF(BadlandParams, rills, "rills", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Least distance from one rill to the next; 0 = as fine as the cells allow, 8 cells."},
    {KEY_OF(BadlandParams, depth, "depth", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Depth to which the last storms cut rills that drain 50 square metres of a wall of 45 "
            "degrees; larger ones are deeper. Gentler walls and what falls in leave about half."},
    {KEY_OF(BadlandParams, slope, "slope", KEY_FLOAT), .low = 20, .high = 80, .unit = "degrees",
     .doc = "The steepest wall of beds whose own `slope` is 45 degrees; others in proportion."},
    {KEY_OF(BadlandParams, wash, "wash", KEY_FLOAT), .high = 0.5f,
     .doc = "Fall of the flat floor of a wash that drains a hectare, m by the metre; larger ones "
            "fall less. More = valleys filled farther up; 0 = none."},
    {KEY_OF(BadlandParams, outlets, "outlets", KEY_INT), .low = 1, .high = 64,
     .doc = "Number of washes that leave over the border."},
    {0},
};

const Table badland_table = {
    .name = "badlands",
    .doc = "Soft bare beds that storm water cuts into gullies and rills with knife edges between "
           "them, and washes on the floors of the valleys. The relief is about the height of the "
           "highest above the outlets.",
    .example = "objects:\n"
               "  - name: breaks\n"
               "    terrain:\n"
               "      form: badlands\n"
               "      size: 400\n"
               "      relief: 45\n"
               "      badlands: {slope: 48}\n",
    .size = sizeof(BadlandParams),
    .keys = BADLAND_KEYS};

static const EnumName SEA_SIDES[] = {
    {"north", SIDE_NORTH}, {"east", SIDE_EAST}, {"south", SIDE_SOUTH}, {"west", SIDE_WEST}, {0}};

static const Key COAST_KEYS[] = {
    {KEY_OF(CoastParams, sea, "sea", KEY_ENUM), .names = SEA_SIDES,
     .doc = "Side of the terrain on which the sea lies."},
    {KEY_OF(CoastParams, waves, "waves", KEY_FLOAT), .low = -70, .high = 70, .unit = "degrees",
     .doc = "Where the waves come from, clockwise from the sea's side, seen from above; 0 = they "
            "come straight in."},
    {KEY_OF(CoastParams, wave_height, "wave_height", KEY_FLOAT), .flags = KEY_ABOVE, .high = 20,
     .unit = "m",
     .doc = "Mean height of the waves: high ones reach deeper, flatten beaches and raise berms."},
    {KEY_OF(CoastParams, tide, "tide", KEY_FLOAT), .low = 0.1, .high = 20, .unit = "m",
     .doc = "Range from low to high water, above and below height 0. Cliffs have their feet at "
            "high water; the larger the tide, the steeper the shore platform."},
    {KEY_OF(CoastParams, retreat, "retreat", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "How far waves have cut back open shore of rock of hardness 0.5; harder rock, bays "
            "and shore behind a beach less, joints more. 0 = 0.2 of the terrain's size."},
    {KEY_OF(CoastParams, sand, "sand", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the worn rock that stays as sand or shingle: it gathers in bays as "
            "beaches; 0 = none."},
    {KEY_OF(CoastParams, grain, "grain", KEY_FLOAT), .low = 0.05, .high = 200, .unit = "mm",
     .doc = "Size of the sand's grains; coarse ones make steep beaches: 0.4 = sand, about 4 "
            "degrees; 20 = shingle, about 10."},
    {KEY_OF(CoastParams, joints, "joints", KEY_FLOAT), .high = 2,
     .doc = "How much the rock's strength differs from place to place: joints, which waves open "
            "to gullies and behind which they leave stacks, and blocks between them; 0 = not at "
            "all."},
    {KEY_OF(CoastParams, joint_spacing, "joint_spacing", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Mean distance between joints of a set; 0 = 0.03 of the terrain's size. The grid must "
            "resolve a tenth of it."},
    {0},
};

const Table coast_table = {
    .name = "coast",
    .doc = "A rocky coast: rolling land that waves cut back to cliffs, with shore platforms, "
           "headlands and coves, gullies and stacks, and beaches where waves are weak. Mean sea "
           "level is at the terrain's position; the sea itself is an object of its own. Caves and "
           "arches are not possible: each place has one height. `beyond` goes on along the shore "
           "and inland.",
    .example = "objects:\n"
               "  - name: coast\n"
               "    terrain:\n"
               "      form: coast\n"
               "      size: 1500\n"
               "      relief: 80\n"
               "      coast: {sea: south, waves: 20, retreat: 180}\n",
    .size = sizeof(CoastParams),
    .keys = COAST_KEYS};

static const Key KARST_KEYS[] = {
    {KEY_OF(KarstParams, stage, "stage", KEY_FLOAT), .high = 2,
     .doc =
         "How far the limestone is dissolved: 0 = a plateau; 0.3 = cones about closed hollows "
         "(fengcong, cockpit karst); 0.8 = towers on a plain (fenglin); above 1.2 few are left."},
    {KEY_OF(KarstParams, spacing, "spacing", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "About the distance from one hollow, or tower, to the next; 0 = 0.09 of the terrain's "
            "size. The grid must resolve a tenth of it."},
    {KEY_OF(KarstParams, focus, "focus", KEY_FLOAT), .high = 3,
     .doc = "How much more water dissolves where it flows together in hollows: 0 = as on summits; "
            "the larger, the steeper the cones."},
    {KEY_OF(KarstParams, river, "river", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Width of a river that crosses from north (-z) to south on its own plain; 0 = none. "
            "Its water is that of water_level: 0.025 fills the bed, 0.06 floods the plain to a bay "
            "of islands."},
    {0},
};

const Table karst_table = {
    .name = "karst",
    .doc = "Limestone that water has dissolved along its joints: hollows, cones and towers with "
           "cliffs, on a flat plain at the water table, which is at the terrain's position; the "
           "plain lies 0.02 of the relief above it. Caves and overhangs are not possible: each "
           "place has one height.",
    .example = "objects:\n"
               "  - name: towers\n"
               "    terrain:\n"
               "      form: karst\n"
               "      size: 4000\n"
               "      relief: 200\n"
               "      water_level: 0.025\n"
               "      karst: {stage: 0.8, river: 120}\n",
    .size = sizeof(KarstParams),
    .keys = KARST_KEYS};

static const Key BRAIDED_KEYS[] = {
    {KEY_OF(BraidedParams, width, "width", KEY_FLOAT), .high = 1e6, .unit = "m",
     .doc = "Mean width of the plain of gravel; 0 = half of the terrain's size."},
    {KEY_OF(BraidedParams, slope, "slope", KEY_FLOAT), .flags = KEY_ABOVE, .high = 0.1,
     .doc = "Fall of the valley, from north (-z) to south, over its length; 0.002 to 0.02 in "
            "nature. Depths are in proportion to it."},
    {KEY_OF(BraidedParams, threads, "threads", KEY_FLOAT), .low = 1, .high = 20,
     .doc = "About how many threads of water run side by side: the narrower each is, the shallower "
            "the river."},
    {KEY_OF(BraidedParams, stage, "stage", KEY_FLOAT), .low = 0.02, .high = 2,
     .doc =
         "The discharge now, as a fraction of the one that has formed the bed: at 1 water covers "
         "most bars, at 0.2 it keeps to a few threads."},
    {KEY_OF(BraidedParams, age, "age", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc =
         "How long the river has worked: 1 = until bars of its own have replaced the first ones; "
         "more = fewer, larger threads."},
    {KEY_OF(BraidedParams, terraces, "terraces", KEY_INT), .high = 5,
     .doc = "Terraces of old gravel on each side, which the river undercuts."},
    {KEY_OF(BraidedParams, terrace_height, "terrace_height", KEY_FLOAT), .flags = KEY_ABOVE,
     .high = 1000, .unit = "m", .doc = "Height of the lowest terrace above the plain."},
    {0},
};

const Table braided_table = {
    .name = "braided",
    .doc = "A river that braids on its plain of gravel, between terraces and steep slopes. The "
           "relief is the height of these slopes.",
    .example = "objects:\n"
               "  - name: valley\n"
               "    terrain:\n"
               "      form: braided\n"
               "      size: 3000\n"
               "      braided: {width: 1500, threads: 6, stage: 0.3}\n",
    .size = sizeof(BraidedParams),
    .keys = BRAIDED_KEYS};

static const Key MEANDER_KEYS[] = {
    {KEY_OF(MeanderParams, width, "width", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc =
         "Width of the river; 0 = a sixtieth of the terrain's size. Bends are about ten times as "
         "long."},
    {KEY_OF(MeanderParams, plain, "plain", KEY_FLOAT), .low = 0.1, .high = 1, .unit = "sizes",
     .doc = "Width of the floodplain between the hills."},
    {KEY_OF(MeanderParams, slope, "slope", KEY_FLOAT), .high = 0.01,
     .doc = "Fall of the valley, from north (-z) to south, over its length."},
    {KEY_OF(MeanderParams, age, "age", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "How long the river has wandered: 0.3 = bends grow, 1 = many have been cut off."},
    {0},
};

const Table meander_table = {
    .name = "meander",
    .doc =
        "A river that winds in its floodplain: outer banks retreat, point bars follow, necks are "
        "cut and leave oxbow lakes that fill.",
    .example = "objects:\n"
               "  - name: valley\n"
               "    terrain:\n"
               "      form: meander\n"
               "      size: 4000\n"
               "      meander: {width: 60}\n",
    .size = sizeof(MeanderParams),
    .keys = MEANDER_KEYS};

static const Key DELTA_KEYS[] = {
    {KEY_OF(DeltaParams, width, "width", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Width of the river, a 64th to a 16th of the terrain's size; 0 = a 40th. Channels and "
            "islands are in proportion to it, so that a narrow river builds many."},
    {KEY_OF(DeltaParams, depth, "depth", KEY_FLOAT), .high = 1e4, .unit = "m",
     .doc = "Depth of the river and of the sea that it fills; 0 = by the river's width: 4.5 m for "
            "200 m."},
    {KEY_OF(DeltaParams, sand, "sand", KEY_FLOAT), .high = 1,
     .doc = "Share of sand in what the river brings, the rest is mud. Mud makes few deep channels "
            "between firm banks and a ragged coast, sand many shallow ones and a smooth coast."},
    {KEY_OF(DeltaParams, age, "age", KEY_FLOAT), .low = 0.02, .high = 2,
     .doc = "How long it has built: the delta's area is in proportion. 1 = it fills the middle of "
            "the square; more reaches its borders, where what comes is lost."},
    {KEY_OF(DeltaParams, rise, "rise", KEY_FLOAT), .high = 2, .unit = "depths",
     .doc = "How far the sea rises meanwhile: land drowns between the channels, which leaves bays "
            "and ponds."},
    {KEY_OF(DeltaParams, plain, "plain", KEY_FLOAT), .low = 0.08, .high = 0.4, .unit = "sizes",
     .doc = "Width of the old land in the north (-z), through which the river comes."},
    {KEY_OF(DeltaParams, creeks, "creeks", KEY_FLOAT), .high = 1,
     .doc =
         "Creeks that drain the marsh at ebb: trees of them branch from the channels and the sea "
         "into the land, down to a fortieth of the river's width. 1 = many; 0 = none but hollows."},
    {KEY_OF(DeltaParams, stirred, "stirred", KEY_FLOAT), .high = 1,
     .doc =
         "How much the water is stirred: eddies curl the plumes at the mouths, mud is drawn out in "
         "ribbons along the flow, and ponds and dead arms in the marsh are dark with peat."},
    {0},
};

const Table delta_table = {
    .name = "delta",
    .doc = "A river that enters a shallow sea in the south (+z). Bars grow before its mouth and "
           "part it again and again; channels shift, old land turns to marsh. The relief has no "
           "meaning; beyond is the open sea and level old land.",
    .example = "objects:\n"
               "  - name: delta\n"
               "    terrain:\n"
               "      form: delta\n"
               "      size: 8000\n"
               "      delta: {width: 180, sand: 0.3}\n",
    .size = sizeof(DeltaParams),
    .keys = DELTA_KEYS};

static const Key EVOLUTION_KEYS[] = {
    {KEY_OF(EvolutionParams, streams, "streams", KEY_FLOAT), .high = 100,
     .doc = "Factor on the erosion by streams."},
    {KEY_OF(EvolutionParams, debris, "debris", KEY_FLOAT), .high = 100,
     .doc = "Factor on debris flows and rockfall, which cut couloirs into the walls of form: alps "
            "and build cones of scree at their feet. 0 = none: rock of one kind without beds or "
            "joints, as plane as it breaks."},
    {KEY_OF(EvolutionParams, weathering, "weathering", KEY_FLOAT), .high = 100,
     .doc = "Factor on the retreat of faces, of soft beds most."},
    {KEY_OF(EvolutionParams, rubble, "rubble", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the fallen rock that stays as rubble at the feet of faces."},
    {KEY_OF(EvolutionParams, repose, "repose", KEY_FLOAT), .low = 1, .high = 60, .unit = "degrees",
     .doc = "Angle of repose of rubble."},
    {KEY_OF(EvolutionParams, deposition, "deposition", KEY_FLOAT), .high = 5,
     .doc = "How readily streams drop their load: 0 = never; 1 and more build fans and floors."},
    {KEY_OF(EvolutionParams, soil, "soil", KEY_FLOAT), .high = 100,
     .doc = "Factor on the making of soil and its creep, which rounds soft ground."},
    {KEY_OF(EvolutionParams, cells, "cells", KEY_INT), .low = 64, .high = 4096,
     .doc = "Largest grid of the processes, cells per side, a power of two. A finer resolution "
            "interpolates along the beds' own profile."},
    {0},
};

const Table evolution_table = {
    .name = "evolution",
    .doc = "Processes that make the landforms: streams that erode and drop their load, weathering "
           "bed by bed, rubble, soil.",
    .size = sizeof(EvolutionParams),
    .keys = EVOLUTION_KEYS};
