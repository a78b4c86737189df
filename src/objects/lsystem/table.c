// A plant written as an L-system.
#include "objects/common/tables.h"
#include "objects/lsystem/plant.h"

static const Key LSYSTEM_KEYS[] = {
    {KEY_OF(LSystemPlantParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Where the root stands."},
    {KEY_OF(LSystemPlantParams, height, "height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "The drawing is scaled to it; 0 = as the turtle draws it."},
    {KEY_OF(LSystemPlantParams, axiom, "axiom", KEY_TEXT),
     .doc = "The string to begin with; left out: a tree."},
    {KEY_OF(LSystemPlantParams, rules, "rules", KEY_TEXT),
     .doc = "The rules, one a line or parted by ';', as \"A(l) : l > 0.1 -> "
            "F(l)[+A(l*0.7)]A(l*0.8) : 0.5\": what is replaced, a condition, by what, with what "
            "probability. \"name = number\" makes a constant."},
    {KEY_OF(LSystemPlantParams, generations, "generations", KEY_INT), .high = 1000,
     .doc = "How often the rules are applied."},
    {KEY_OF(LSystemPlantParams, angle, "angle", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Angle of turns that name none."},
    {KEY_OF(LSystemPlantParams, step, "step", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m", .doc = "Length of an F without parameter, and unit of those with one."},
    {KEY_OF(LSystemPlantParams, tropism, "tropism", KEY_VECTOR), .count = 3, .low = -1000,
     .high = 1000, .doc = "The vector that segments bend toward."},
    {KEY_OF(LSystemPlantParams, elasticity, "elasticity", KEY_FLOAT), .low = -10, .high = 10,
     .unit = "radians", .doc = "How far a segment that stands across the tropism bends."},
    {KEY_OF(LSystemPlantParams, noise, "noise", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Standard deviation that is added to every turn."},
    {KEY_OF(LSystemPlantParams, radius, "radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc =
         "Radius at the root; 0 = 0.02 of the height, or what the pipe model makes of the tips'."},
    {KEY_OF(LSystemPlantParams, radii, "radii", KEY_GROUP), .table = &radii_table,
     .doc = "Thickness where the string sets no widths by '!'."},
    {KEY_OF(LSystemPlantParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "Leaves on its thin ends."},
    {KEY_OF(LSystemPlantParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc = "The surface."},
    {0},
};

static void lsystem_defaults(void *out)
{
    *(LSystemPlantParams *)out = lsystem_plant_params_default();
}

static bool check_lsystem(const Mapping *mapping, void *params)
{
    const LSystemPlantParams *plant = params;
    return (!plant->axiom && !plant->rules) || check_grammar(mapping, plant->axiom, plant->rules);
}

const Table lsystem_table = {.name = "lsystem",
                             .doc = "A plant written as an L-system: parametric, stochastic rules "
                                    "and a turtle in space. Materials: bark, twig, leaf.",
                             .example = "objects:\n"
                                        "  - name: weed\n"
                                        "    lsystem: {height: 0.6, axiom: X, rules: \"X -> "
                                        "F[+X][-X]FX; F -> FF\", generations: 5, angle: 26}\n",
                             .size = sizeof(LSystemPlantParams),
                             .keys = LSYSTEM_KEYS,
                             .defaults = lsystem_defaults,
                             .check = check_lsystem};
