// An L-system string as a growth rule (Horiuchi, step b): each F is a direction in which a node may
// grow, + - & ^ \ / | rotate it, [ ] branch. The string becomes a tree of directions: a node at an
// F may grow into the F's that follow it.
#ifndef RAMIFY_GROW_RULES_GROW_STRING_H
#define RAMIFY_GROW_RULES_GROW_STRING_H

#include "grow/lsystem/lsystem.h"

#include "base/vec.h"

typedef struct GrowDirection {
    Vec3 heading, normal;     // unit, in (heading, normal, side) components of the preceding node
    float length;             // factor on the growth distance: the parameter of F(l)
    int32_t parent;           // the preceding direction
    int32_t first, followers; // range of the directions that follow it
} GrowDirection;

typedef struct GrowString {
    GrowDirection *direction; // owned; number 0 is the start, before any F
    int64_t count, capacity;
    int most_followers;
} GrowString;

// degrees: angle of turns without parameter. ERROR_INPUT for unmatched brackets, an f (branches
// cannot jump), a $ (the vertical is unknown), no F at all, or more than MAX_SECTORS directions
// from one node.
bool grow_string_init(GrowString *string, const ModuleString *modules, float degrees, Error *e);
void grow_string_clear(GrowString *string);

#endif
