// What an L-system string means to growth (Horiuchi, step b): each F is a direction in which
// a node may grow, + - & ^ \ / | turn it, [ ] branch. The string as a tree of directions: a node
// that stands at an F may grow into the F's that follow it.
#ifndef RAMIFY_GROW_RULES_GROW_STRING_H
#define RAMIFY_GROW_RULES_GROW_STRING_H

#include "grow/lsystem/lsystem.h"

#include "base/vec.h"

typedef struct GrowDirection {
    Vec3 heading, normal;     // unit, in (heading, normal, side) components of the node before it
    float length;             // factor on the growth distance: the parameter of F(l)
    int32_t parent;           // the direction before it
    int32_t first, followers; // those that follow it stand one after another
} GrowDirection;

typedef struct GrowString {
    GrowDirection *direction; // owned; number 0 is the start, before any F
    int64_t count, capacity;
    int most_followers;
} GrowString;

// degrees: of turns without parameter. ERROR_INPUT for brackets that do not match, an f (a branch
// cannot jump), a $ (it does not know the vertical), no F at all, or more than MAX_SECTORS
// directions from one node.
bool grow_string_init(GrowString *string, const ModuleString *modules, float degrees, Error *e);
void grow_string_clear(GrowString *string);

#endif
