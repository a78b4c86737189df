// A plant written as an L-system, for comparison with grown trees (Tanaka et al., figure 19 a).
#ifndef RAMIFY_OBJECTS_LSYSTEM_PLANT_H
#define RAMIFY_OBJECTS_LSYSTEM_PLANT_H

#include "objects/common/recipe.h"
#include "objects/tree/tree.h"

typedef struct LSystemPlantParams {
    Vec3 position;       // m, of the root
    float height;        // m: the drawing is scaled to it; 0 = not scaled
    char *axiom, *rules; // NULL = a tree of the book, figure 2.7 a; borrowed
    int generations;
    float angle;       // degrees, of turns without an angle
    float step;        // m, of an F(1)
    Vec3 tropism;      // vector that segments bend toward
    float elasticity;  // radians of bending per segment across it
    float noise;       // degrees, of every turn
    float radius;      // m, at the root; 0 = 0.02 of the height
    RadiiParams radii; // used if the string sets no widths (!)
    LeavesParams leaves;
    SkinningParams skin;
} LSystemPlantParams;

LSystemPlantParams lsystem_plant_params_default(void);

// The recipe (see recipe.h). Derives the string, draws it, scales it to the height. Roles of
// materials as for a tree.
bool lsystem_plant_grow(const void *params, const Recipe *recipe, Grown *whole, Error *e);
bool lsystem_plant_finish(const void *params, const Recipe *recipe, const Grown *whole,
                          Grown *grown, Error *e);
bool lsystem_plant_geometry(const void *params, const Grown *grown, const Placing *placing,
                            Error *e);

extern const struct Table lsystem_table; // of its parameters

#endif
