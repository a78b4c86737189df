// A plant written as an L-system.
#include "objects/common/tables.h"
#include "objects/lsystem/plant.h"

static const Key LSYSTEM_KEYS[] = {
    {KEY_OF(LSystemPlantParams, position, "position", KEY_VECTOR), .count = 3, .unit = "m",
     .doc = "Position of the root."},
    {KEY_OF(LSystemPlantParams, height, "height", KEY_FLOAT), .high = 1000, .unit = "m",
     .doc = "Height to which the plant is scaled; 0 = not scaled."},
    {KEY_OF(LSystemPlantParams, axiom, "axiom", KEY_TEXT),
     .doc = "Axiom (initial string); default: a tree."},
    {KEY_OF(LSystemPlantParams, rules, "rules", KEY_TEXT),
     .doc = "Rules, one per line or separated by ';', as in \"A(l) : l > 0.1 -> "
            "F(l)[+A(l*0.7)]A(l*0.8) : 0.5\": predecessor, condition, successor, probability. "
            "\"name = number\" defines a constant."},
    {KEY_OF(LSystemPlantParams, generations, "generations", KEY_INT), .high = 1000,
     .doc = "Number of times the rules are applied."},
    {KEY_OF(LSystemPlantParams, angle, "angle", KEY_FLOAT), .low = -360, .high = 360,
     .unit = "degrees", .doc = "Angle of turns that have no parameter."},
    {KEY_OF(LSystemPlantParams, step, "step", KEY_FLOAT), .flags = KEY_ABOVE, .high = 1000,
     .unit = "m",
     .doc = "Length of an F without a parameter, and unit of length of an F with one."},
    {KEY_OF(LSystemPlantParams, tropism, "tropism", KEY_VECTOR), .count = 3, .low = -1000,
     .high = 1000, .doc = "Vector toward which segments bend."},
    {KEY_OF(LSystemPlantParams, elasticity, "elasticity", KEY_FLOAT), .low = -10, .high = 10,
     .unit = "radians", .doc = "Bending angle of a segment at right angles to the tropism."},
    {KEY_OF(LSystemPlantParams, noise, "noise", KEY_FLOAT), .high = 180, .unit = "degrees",
     .doc = "Standard deviation of the Gaussian noise added to every turn."},
    {KEY_OF(LSystemPlantParams, radius, "radius", KEY_FLOAT), .high = 100, .unit = "m",
     .doc = "Radius at the root; 0 = 0.02 of the height, or the pipe model's result from the "
            "radius of the tips."},
    {KEY_OF(LSystemPlantParams, radii, "radii", KEY_GROUP), .table = &radii_table,
     .doc = "Thickness, where the string sets no widths with '!'."},
    {KEY_OF(LSystemPlantParams, leaves, "leaves", KEY_GROUP), .table = &leaves_table,
     .doc = "Leaves on the thin branches."},
    {KEY_OF(LSystemPlantParams, skin, "skin", KEY_GROUP), .table = &skin_table,
     .doc = "Surface of the branches."},
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
                             .doc = "A plant described by an L-system: parametric, stochastic "
                                    "rules and a 3D turtle. Materials: bark, twig, leaf.",
                             .example = "objects:\n"
                                        "  - name: weed\n"
                                        "    lsystem: {height: 0.6, axiom: X, rules: \"X -> "
                                        "F[+X][-X]FX; F -> FF\", generations: 5, angle: 26}\n",
                             .size = sizeof(LSystemPlantParams),
                             .keys = LSYSTEM_KEYS,
                             .defaults = lsystem_defaults,
                             .check = check_lsystem};
