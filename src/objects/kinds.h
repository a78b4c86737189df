// The registry of kinds of objects, one line each, in the order of the documentation.
#ifndef RAMIFY_OBJECTS_KINDS_H
#define RAMIFY_OBJECTS_KINDS_H

#include "objects/kind.h"

#define KINDS(X)    \
    X(tree)         \
    X(coral)        \
    X(lsystem)      \
    X(vessels)      \
    X(forest)       \
    X(ground)       \
    X(frost)        \
    X(mesh)         \
    X(shape)        \
    X(dla)          \
    X(lightning)    \
    X(sculpture)    \
    X(terrain)      \
    X(venation)     \
    X(fracture)     \
    X(skeleton)     \
    X(outtree)      \
    X(climber)      \
    X(stone)        \
    X(scatter)      \
    X(row)          \
    X(swarm)        \
    X(sea)          \
    X(snow_crystal) \
    X(frost_flower) \
    X(ice_cracks)   \
    X(eruption)     \
    X(cascade)

#define DECLARE_KIND(NAME) extern const Kind kind_##NAME;
KINDS(DECLARE_KIND)
#undef DECLARE_KIND

#endif
