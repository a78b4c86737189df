// Frost: the surface, the nuclei, the field, spines and sides.
#include "objects/common/tables.h"
#include "objects/frost/frost.h"

#define BIT(kind) (1u << (kind))

static const EnumName SURFACES[] = {{"pane", FROST_PANE}, {"bubble", FROST_BUBBLE}, {0}};
static const EnumName PLACES[] = {{"border", FROST_BORDER}, {"scattered", FROST_SCATTERED}, {0}};

static const Key NUCLEUS_KEYS[] = {
    {KEY_OF(FrostNucleus, position, "position", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3,
     .unit = "m", .doc = "Where; it is taken to the nearest point of the pane or bubble."},
    {0},
};

static const Table NUCLEUS_TABLE = {.name = "nucleus",
                                    .doc = "A place where a crystal begins.",
                                    .size = sizeof(FrostNucleus),
                                    .keys = NUCLEUS_KEYS};

static const Key FROST_KEYS[] = {
    {KEY_OF(FrostParams, surface, "surface", KEY_ENUM), .names = SURFACES,
     .doc = "pane: a rectangle that faces +Z; bubble: a sphere that freezes from below."},
    {KEY_OF(FrostParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Middle of the pane or the bubble."},
    {KEY_OF(FrostParams, width, "width", KEY_FLOAT), .kinds = BIT(FROST_PANE), .flags = KEY_ABOVE,
     .high = 1000, .unit = "m", .doc = "Width of the pane."},
    {KEY_OF(FrostParams, height, "height", KEY_FLOAT), .kinds = BIT(FROST_PANE), .flags = KEY_ABOVE,
     .high = 1000, .unit = "m", .doc = "Height of the pane."},
    {KEY_OF(FrostParams, radius, "radius", KEY_FLOAT), .kinds = BIT(FROST_BUBBLE),
     .flags = KEY_ABOVE, .high = 1000, .unit = "m", .doc = "Radius of the bubble."},
    {KEY_OF(FrostParams, nuclei, "nuclei", KEY_INT), .low = 1, .high = 100000,
     .doc = "How many crystals begin, where none are listed."},
    {KEY_OF(FrostParams, place, "place", KEY_ENUM), .kinds = BIT(FROST_PANE), .names = PLACES,
     .doc = "border: crystals begin along the pane's border; scattered: anywhere on it."},
    {KEY_OF(FrostParams, nucleus, "nucleus", KEY_LIST),
     .count_offset = offsetof(FrostParams, nucleus_count), .count = 100000, .table = &NUCLEUS_TABLE,
     .doc = "Where crystals begin, instead of at random."},
    {KEY_OF(FrostParams, turn, "turn", KEY_FLOAT), .low = -36000, .high = 36000, .unit = "degrees",
     .doc = "Azimuth that the field's streamlines sweep from a nucleus to the rim."},
    {KEY_OF(FrostParams, field_weight, "field_weight", KEY_FLOAT), .high = 1000,
     .doc = "Weight of that field against the pull of the free surface."},
    {KEY_OF(FrostParams, spines, "spines", KEY_INT64), .low = 1, .high = 2147483647,
     .doc = "Attractors of the spines: more make them stand closer."},
    {KEY_OF(FrostParams, sides, "sides", KEY_INT64), .high = 2147483647,
     .doc = "Attractors of the side branches: more make them finer; 0 = bare spines."},
    {KEY_OF(FrostParams, angle, "angle", KEY_FLOAT), .low = 20, .high = 90, .unit = "degrees",
     .doc = "Angle between a side and what it leaves; 60 for ice."},
    {KEY_OF(FrostParams, skip, "skip", KEY_FLOAT), .high = 1,
     .doc = "Probability that a side does not grow."},
    {KEY_OF(FrostParams, orders, "orders", KEY_INT), .low = 1, .high = 100,
     .doc = "Orders of branching: 1 = sides, 2 = sides of sides ..."},
    {KEY_OF(FrostParams, width_share, "width_share", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Half-width of the finest blades, in mean spacings of the sides' attractors."},
    {KEY_OF(FrostParams, relief, "relief", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Height of a blade's rib over its half-width."},
    {KEY_OF(FrostParams, rime, "rime", KEY_FLOAT), .high = 1,
     .doc = "Share of the sides that are white with enclosed air instead of clear."},
    {KEY_OF(FrostParams, grains, "grains", KEY_INT64), .high = 1e8,
     .doc = "Loose crystals, mostly near the border or about the nucleus; 0 = none."},
    {0},
};

static void frost_defaults(const Node *given, int kind, void *out)
{
    (void)given;
    *(FrostParams *)out = frost_params_default(kind < 0 ? FROST_PANE : (FrostSurface)kind);
}

const Table frost_table = {
    .name = "frost",
    .doc = "Frost on a pane or a bubble (Tanaka et al., section 5.3). Materials: ice, rime; the "
           "pane or the bubble is an object of its own.",
    .example = "objects:\n"
               "  - name: window\n"
               "    frost: {surface: pane, width: 0.5, height: 0.4, nuclei: 9, turn: 140}\n",
    .size = sizeof(FrostParams),
    .keys = FROST_KEYS,
    .kind_key = "surface",
    .kind_defaults = frost_defaults};
