// Frost: the surface, the nuclei, the field, spines and sides.
#include "objects/common/tables.h"
#include "objects/frost/frost.h"

#include <string.h>

#define BIT(kind) (1u << (kind))

static const EnumName SURFACES[] = {{"pane", FROST_PANE}, {"bubble", FROST_BUBBLE}, {0}};
static const EnumName HABITS[] = {{"spines", FROST_SPINES}, {"ferns", FROST_FERNS}, {0}};
static const EnumName PLACES[] = {{"border", FROST_BORDER}, {"scattered", FROST_SCATTERED}, {0}};

static const Key NUCLEUS_KEYS[] = {
    {KEY_OF(FrostNucleus, position, "position", KEY_VECTOR), .flags = KEY_REQUIRED, .count = 3,
     .unit = "m",
     .doc = "Position of the nucleus; it is moved to the nearest point of the pane or bubble."},
    {0},
};

static const Table NUCLEUS_TABLE = {.name = "nucleus",
                                    .doc = "Starting point of a crystal.",
                                    .size = sizeof(FrostNucleus),
                                    .keys = NUCLEUS_KEYS};

static const Key FROST_KEYS[] = {
    {KEY_OF(FrostParams, surface, "surface", KEY_ENUM), .names = SURFACES,
     .doc = "pane: a rectangle facing +Z; bubble: a sphere that freezes from below."},
    {KEY_OF(FrostParams, habit, "habit", KEY_ENUM), .names = HABITS,
     .doc =
         "spines: straight needles at 60 degrees; ferns: plumes, whose ribs curve, with barbs and "
         "barbules that follow them, until they meet others."},
    {KEY_OF(FrostParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the pane or bubble."},
    {KEY_OF(FrostParams, width, "width", KEY_FLOAT), .kinds = BIT(FROST_PANE), .flags = KEY_ABOVE,
     .high = 1000, .unit = "m", .doc = "Width of the pane."},
    {KEY_OF(FrostParams, height, "height", KEY_FLOAT), .kinds = BIT(FROST_PANE), .flags = KEY_ABOVE,
     .high = 1000, .unit = "m", .doc = "Height of the pane."},
    {KEY_OF(FrostParams, radius, "radius", KEY_FLOAT), .kinds = BIT(FROST_BUBBLE),
     .flags = KEY_ABOVE, .high = 1000, .unit = "m", .doc = "Radius of the bubble."},
    {KEY_OF(FrostParams, nuclei, "nuclei", KEY_INT), .low = 1, .high = 100000,
     .doc = "Number of crystals, if nucleus lists none."},
    {KEY_OF(FrostParams, place, "place", KEY_ENUM), .kinds = BIT(FROST_PANE), .names = PLACES,
     .doc = "border: crystals start along the pane's border; scattered: anywhere on it."},
    {KEY_OF(FrostParams, nucleus, "nucleus", KEY_LIST),
     .count_offset = offsetof(FrostParams, nucleus_count), .count = 100000, .table = &NUCLEUS_TABLE,
     .doc = "Starting points of crystals, instead of random ones."},
    {KEY_OF(FrostParams, turn, "turn", KEY_FLOAT), .low = -36000, .high = 36000, .unit = "degrees",
     .doc = "Angle that the field's streamlines sweep from a nucleus to the rim."},
    {KEY_OF(FrostParams, profile, "profile", KEY_ENUM), .names = field_profiles,
     .doc = "Spines: swept: the field's streamlines sweep `turn`; spines also follow the free "
            "surface and "
            "sweep less; grown: the field is turned further, so that the spines sweep `turn`; "
            "constant: every vector is turned by `turn`."},
    {KEY_OF(FrostParams, field_weight, "field_weight", KEY_FLOAT), .high = 1000,
     .doc = "Weight of the field relative to the pull of the free surface."},
    {KEY_OF(FrostParams, spines, "spines", KEY_INT64), .low = 1, .high = 2147483647,
     .doc = "Number of attractors of the spines; more give denser spines. Ferns: they set the "
            "spacing of ribs and the length of barbs."},
    {KEY_OF(FrostParams, sides, "sides", KEY_INT64), .high = 2147483647,
     .doc = "Number of attractors of the side branches, of ferns the barbs; more give finer "
            "branches, 0 = bare spines."},
    {KEY_OF(FrostParams, angle, "angle", KEY_FLOAT), .low = 20, .high = 90, .unit = "degrees",
     .doc = "Angle between a side branch and its parent: 60 for ice, in ferns 50."},
    {KEY_OF(FrostParams, skip, "skip", KEY_FLOAT), .high = 1,
     .doc = "Probability that a side branch does not grow."},
    {KEY_OF(FrostParams, orders, "orders", KEY_INT), .low = 1, .high = 100,
     .doc = "Orders of branching: 1 = side branches, 2 = their side branches too, and so on."},
    {KEY_OF(FrostParams, curl, "curl", KEY_FLOAT), .high = 90, .unit = "degrees",
     .doc = "Ferns: angle by which barbs bend toward the direction of their rib."},
    {KEY_OF(FrostParams, scratches, "scratches", KEY_INT), .kinds = BIT(FROST_PANE), .high = 10000,
     .doc = "Ferns: number of scratches in the glass, from which plumes grow to both sides."},
    {KEY_OF(FrostParams, clear, "clear", KEY_FLOAT), .high = 1,
     .doc = "Ferns: share of the surface that stays clear, in islands."},
    {KEY_OF(FrostParams, width_share, "width_share", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Half-width of the finest blades, in mean spacings of the side branches' attractors."},
    {KEY_OF(FrostParams, relief, "relief", KEY_FLOAT), .flags = KEY_ABOVE, .high = 10,
     .doc = "Height of a blade's rib, relative to its half-width."},
    {KEY_OF(FrostParams, rime, "rime", KEY_FLOAT), .high = 1,
     .doc = "Fraction of the side branches that are white with enclosed air instead of clear."},
    {KEY_OF(FrostParams, grains, "grains", KEY_INT64), .high = 1e8,
     .doc = "Number of loose crystals, mostly near the border or about the nucleus; 0 = none."},
    {0},
};

static void frost_defaults(const Node *given, int kind, void *out)
{
    const char *habit = given ? node_get_text(given, "habit") : NULL;
    bool ferns = habit && strcmp(habit, HABITS[FROST_FERNS].name) == 0;
    *(FrostParams *)out = frost_habit_default(kind < 0 ? FROST_PANE : (FrostSurface)kind,
                                              ferns ? FROST_FERNS : FROST_SPINES);
}

const Table frost_table = {
    .name = "frost",
    .doc = "Frost on a pane or a bubble (Tanaka et al., section 5.3). Materials: ice, rime. The "
           "pane or bubble itself is a separate object.",
    .example = "objects:\n"
               "  - name: window\n"
               "    frost: {surface: pane, width: 0.5, height: 0.4, nuclei: 9, turn: 140}\n",
    .size = sizeof(FrostParams),
    .keys = FROST_KEYS,
    .kind_key = "surface",
    .kind_defaults = frost_defaults};
