// Every kind of object, one kind_*.c each.
#ifndef RAMIFY_SCENE_KINDS_H
#define RAMIFY_SCENE_KINDS_H

#include "scene/kind.h"

extern const Kind kind_tree, kind_forest, kind_ground, kind_mesh, kind_shape, kind_dla,
    kind_lightning;
extern const Kind kind_coral, kind_lsystem;
extern const Kind kind_frost;
extern const Kind kind_sculpture;
extern const Kind kind_terrain;
extern const Kind kind_vessels;
extern const Kind kind_venation;
extern const Kind kind_fracture;
extern const Kind kind_skeleton;

#endif
