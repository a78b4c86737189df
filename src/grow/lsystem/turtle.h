// The turtle: interprets a string of modules as moves and rotations in space (Lindenmayer 1968, The
// Algorithmic Beauty of Plants 1.5). Heading H, left L, up U, with H x L = U. Angles in degrees:
// the symbol's own parameter or the turtle's default.
//
//     F(l) forward, drawing       f(l) forward without drawing    !(w) width from here on, m
//     + -  turn left, right       & ^  pitch down, up             \ /  roll left, right
//     |    turn around            $    roll until L is horizontal [ ]  branch: push, pop state
//
// Other symbols are ignored.
#ifndef RAMIFY_GROW_LSYSTEM_TURTLE_H
#define RAMIFY_GROW_LSYSTEM_TURTLE_H

#include "grow/lsystem/lsystem.h"
#include "outtree/out_tree.h"

typedef struct TurtleFrame {
    Vec3 heading, left, up; // unit, right-handed
} TurtleFrame;

// Applies a turning symbol ( + - & ^ \ / | $ ) to the frame; false if the module is none.
bool turtle_turn(TurtleFrame *frame, char symbol, float degrees);

typedef struct TurtleParams {
    Vec3 position;    // start, m
    float step;       // m, of an F or f without parameter; also the unit of their parameters
    float angle;      // degrees, of turns without parameter
    Vec3 tropism;     // direction that segments bend toward
    float elasticity; // susceptibility: after each segment the turtle turns by this many radians
                      // times |H x T|
    float width;      // m, at the start; 0 = radii stay 0 until a ! sets a width
    float shrink;     // factor of a ! without parameter
    float noise;      // degrees: standard deviation added to every turn, keyed by place
    uint64_t seed;
} TurtleParams;

TurtleParams turtle_params_default(void); // step 1 m, angle 30 degrees, everything else off

// Draws the string as an out-tree: a node at each end of an F, a new root where drawing resumes
// after an f. Births count the F's from the root. ERROR_INPUT for unmatched brackets and for
// strings that draw nothing. The caller frees the tree.
OutTree *turtle_draw(const ModuleString *string, const TurtleParams *params, const Run *run,
                     Error *e);

#endif
