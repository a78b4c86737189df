// The turtle: reads a string of modules as moves and turns in space (The Algorithmic Beauty of
// Plants, section 1.5). Heading H, left L, up U, with H x L = U; angles in degrees, each symbol's
// own parameter or the turtle's default.
//
//     F(l) forward, drawing       f(l) forward without drawing    !(w) width of what follows, m
//     + -  turn left, right       & ^  pitch down, up             \ /  roll left, right
//     |    turn about             $    roll until L is level      [ ]  branch: remember, return
//
// Other symbols mean nothing to it.
#ifndef RAMIFY_GROW_LSYSTEM_TURTLE_H
#define RAMIFY_GROW_LSYSTEM_TURTLE_H

#include "grow/lsystem/lsystem.h"
#include "outtree/out_tree.h"

typedef struct TurtleFrame {
    Vec3 heading, left, up; // unit, right-handed
} TurtleFrame;

// Applies a turning symbol ( + - & ^ \ / | $ ) to the frame; false when the module is none.
bool turtle_turn(TurtleFrame *frame, char symbol, float degrees);

typedef struct TurtleParams {
    Vec3 position;    // m, of the start
    float step;       // m, of an F or f without parameter; also the unit of their parameters
    float angle;      // degrees, of turns without parameter
    Vec3 tropism;     // the vector that segments bend toward
    float elasticity; // how readily: after each segment the turtle turns by this many radians times
                      // |H x T|
    float width;      // m, at the start; 0 = the tree's radii stay 0 until some ! gives widths
    float shrink;     // factor of a ! without parameter
    float noise;      // degrees: standard deviation of every turn, keyed by place
    uint64_t seed;
} TurtleParams;

TurtleParams turtle_params_default(void); // step 1 m, angle 30 degrees, nothing else

// Draws the string as an out-tree: a node at each end of an F, roots where drawing starts anew
// after an f. Births count the F's from the root. ERROR_INPUT for brackets that do not match and
// for strings that draw nothing.
OutTree *turtle_draw(const ModuleString *string, const TurtleParams *params, const Run *run,
                     Error *e);

#endif
