// The coral: form, L-system, colonies, corallites, rock.
#include "objects/common/tables.h"
#include "objects/coral/coral.h"

static const EnumName FORMS[] = {
    {"branching", CORAL_BRANCHING},   {"table", CORAL_TABLE},     {"fan", CORAL_FAN},
    {"encrusting", CORAL_ENCRUSTING}, {"massive", CORAL_MASSIVE}, {0}};
static const EnumName RULES[] = {{"string", CORAL_STRING}, {"mean", CORAL_MEAN}, {0}};

static const EnumName POLYP_SHAPES[] = {{"tube", POLYP_TUBE}, {"nose", POLYP_NOSE}, {0}};

static const Key POLYP_KEYS[] = {
    {KEY_OF(PolypParams, shape, "shape", KEY_ENUM), .names = POLYP_SHAPES,
     .doc = "tube: straight round cups; nose: as of staghorn corals: they swell out of the tissue "
            "and bend along the branch, with a longer outer lip, no two alike, smaller toward the "
            "tip, which ends in one straight cup."},
    {KEY_OF(PolypParams, max_count, "max_count", KEY_INT64), .high = 1e8,
     .doc = "Maximum number of cups modelled as geometry; 0 = none: only the material's pattern "
            "shows them."},
    {KEY_OF(PolypParams, diameter, "diameter", KEY_FLOAT), .high = 10, .unit = "m",
     .doc = "Diameter of a cup's rim; 0 = a fraction of the colony's size."},
    {KEY_OF(PolypParams, spacing, "spacing", KEY_FLOAT), .high = 10, .unit = "m",
     .doc = "Minimum distance between the cups' centres; 0 = 1.6 diameters."},
    {KEY_OF(PolypParams, height, "height", KEY_FLOAT), .high = 10, .unit = "m",
     .doc = "Height of a cup's wall; 0 = 0.9 diameters."},
    {KEY_OF(PolypParams, lean, "lean", KEY_FLOAT), .high = 85, .unit = "degrees",
     .doc = "Angle by which cups lean toward the branch's tip."},
    {KEY_OF(PolypParams, fill, "fill", KEY_FLOAT), .high = 1,
     .doc = "How many of the gaps between the cups smaller, younger ones fill; 0 = none."},
    {KEY_OF(PolypParams, tentacles, "tentacles", KEY_FLOAT), .high = 1,
     .doc = "Share of the polyps that are out, with twelve tentacles each; shape nose."},
    {0},
};

static const Table POLYP_TABLE = {.name = "polyps",
                                  .doc = "Corallites: the cups in which polyps sit.",
                                  .size = sizeof(PolypParams),
                                  .keys = POLYP_KEYS};

static const Key CORAL_KEYS[] = {
    {KEY_OF(CoralParams, form, "form", KEY_ENUM), .names = FORMS,
     .doc = "branching: a bush, like staghorn coral; table: a plate with upright branchlets; fan: "
            "a flat fan; encrusting: a crust over a rock; massive: a boulder."},
    {KEY_OF(CoralParams, rule, "rule", KEY_ENUM), .names = RULES,
     .doc = "string: the L-system gives directions, the attractors limit the space; mean: "
            "attractors only."},
    {KEY_OF(CoralParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Centre of the colonies, on the sea floor."},
    {KEY_OF(CoralParams, size, "size", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000, .unit = "m",
     .doc = "Width of a colony; other sizes that are omitted or 0 follow it."},
    {KEY_OF(CoralParams, height, "height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Height of a colony; 0 = the form's default, a fraction of the size."},
    {KEY_OF(CoralParams, colonies, "colonies", KEY_INT), .low = 1, .high = 64,
     .doc = "Number of colonies that compete for the same space."},
    {KEY_OF(CoralParams, spread, "spread", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Radius of the circle on which the colonies stand; 0 = 0.42 of the size."},
    {KEY_OF(CoralParams, attractors, "attractors", KEY_INT64), .high = 1e8,
     .doc = "Number of attractors per colony (of the whole rock for forms that grow on one); 0 = "
            "the form's default."},
    {KEY_OF(CoralParams, axiom, "axiom", KEY_TEXT),
     .doc = "Axiom (initial string) of the L-system; default: the form's."},
    {KEY_OF(CoralParams, rules, "rules", KEY_TEXT),
     .doc = "Rules of the L-system, one per line or separated by ';', as in \"X -> [+FX][-FX]FX\"; "
            "default: the form's."},
    {KEY_OF(CoralParams, generations, "generations", KEY_INT), .high = 40,
     .doc = "Number of times the rules are applied; 0 = the form's default."},
    {KEY_OF(CoralParams, angle, "angle", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Angle of turns that have no parameter; 0 = the form's default."},
    {KEY_OF(CoralParams, group, "group", KEY_FLOAT), .high = 360, .unit = "degrees",
     .doc = "Angular width of a direction, which owns the attractors within half of it; 0 = the "
            "form's default."},
    {KEY_OF(CoralParams, regularity, "regularity", KEY_FLOAT), .low = -1, .high = 1,
     .doc = "Regularity of directions: 0 = toward the attractors that a direction owns, 1 = "
            "exactly as the L-system says; -1 = the form's default."},
    {KEY_OF(CoralParams, noise, "noise", KEY_FLOAT), .low = -1, .high = 10,
     .doc = "Gaussian noise added to each component of the direction; -1 = the form's default."},
    {KEY_OF(CoralParams, length, "length", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of growth steps next to the root; 0 = the form's default, a fraction of the "
            "size."},
    {KEY_OF(CoralParams, length_tip, "length_tip", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Length of growth steps farthest from the root; 0 = the form's default, a fraction of "
            "the size."},
    {KEY_OF(CoralParams, light, "light", KEY_FLOAT), .high = 1,
     .doc = "Effect of light: how much more space to grow there is above than below."},
    {KEY_OF(CoralParams, tip_radius, "tip_radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius of the branches' tips; 0 = the form's default, a fraction of the size."},
    {KEY_OF(CoralParams, exponent, "exponent", KEY_FLOAT), .low = 1, .high = 10,
     .doc = "Exponent e of the radii, r_parent^e = sum of r_child^e; 4 keeps branches nearly as "
            "thin as their tips."},
    {KEY_OF(CoralParams, taper, "taper", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Distance from a tip over which a branch thickens to its full radius; 0 = only its "
            "last growth step is thinner."},
    {KEY_OF(CoralParams, fuse, "fuse", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Distance over which the tips of branches fuse with other branches ahead of them "
            "(anastomosis), which makes the net of a sea fan and the lattice of a table's plate; "
            "0 = they stay apart. Forms branching, table and fan."},
    {KEY_OF(CoralParams, bridge, "bridge", KEY_FLOAT), .high = 100, .unit = "m",
     .doc =
         "With fuse: distance along branches between bridges that grow from their sides to other "
         "branches within fuse; 0 = tips alone fuse."},
    {KEY_OF(CoralParams, branchlet, "branchlet", KEY_FLOAT), .high = 10, .unit = "m",
     .doc = "Form table: height of the upright branchlets, which also sets their spacing; 0 = 0.05 "
            "of the size."},
    {KEY_OF(CoralParams, plate, "plate", KEY_FLOAT), .high = 10, .unit = "m",
     .doc = "Form table: thickness of the space in which the plate grows; 0 = 0.044 of the size."},
    {KEY_OF(CoralParams, eccentric, "eccentric", KEY_FLOAT), .high = 1,
     .doc = "Form table: distance of the stalk from the plate's middle, as a fraction of half the "
            "size."},
    {KEY_OF(CoralParams, uneven, "uneven", KEY_FLOAT), .high = 1,
     .doc = "How uneven a table or a fan is. Form table: tilted, with a lobed margin, its lobes "
            "lying a little above and below each other; 0 = a level disc. Form fan: bent out of "
            "its plane, with a margin in lobes of different lengths and clefts between them; 0 = "
            "half an ellipse in a plane."},
    {KEY_OF(CoralParams, pale, "pale", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Distance from a growing tip over which the tissue is pale; 0 = 4 tip radii."},
    {KEY_OF(CoralParams, polyps, "polyps", KEY_GROUP), .table = &POLYP_TABLE,
     .doc = "Corallites: the cups in which polyps sit."},
    {KEY_OF(CoralParams, base, "base", KEY_LIST), .count_offset = offsetof(CoralParams, base_count),
     .count = 1000, .table = &shape_table,
     .doc = "Shapes of the rock on which encrusting and massive forms grow; default: a boulder as "
            "wide as size."},
    {KEY_OF(CoralParams, levels, "levels", KEY_INT), .high = 4,
     .doc = "Number of subdivision levels of the branches' skin."},
    {0},
};

static void coral_defaults(void *out)
{
    *(CoralParams *)out = coral_params_default();
}

// An axiom alone may use constants of the form's own rules: the growth, which begins with it, looks
// at those.
static bool check_coral(const Mapping *mapping, void *params)
{
    const CoralParams *coral = params;
    return check_shapes(mapping, "base", coral->base, coral->base_count) &&
           (!coral->rules || check_grammar(mapping, coral->axiom, coral->rules));
}

const Table coral_table = {
    .name = "coral",
    .doc =
        "Corals (Horiuchi et al.): an L-system gives the branches' directions, attractors the "
        "available space, and colonies compete for it. Materials: coral, coral_polyp, reef_rock.",
    .example = "objects:\n"
               "  - name: staghorn\n"
               "    coral: {form: branching, size: 0.4, colonies: 3}\n",
    .size = sizeof(CoralParams),
    .keys = CORAL_KEYS,
    .defaults = coral_defaults,
    .check = check_coral};
