// The materials that every scene has without naming them.
#ifndef RAMIFY_SCENE_BUILTIN_H
#define RAMIFY_SCENE_BUILTIN_H

#include "render/material/material.h"

// Those that several kinds of objects use, then each kind's own (Kind.builtin). NULL from their
// number on.
const Material *builtin_material_at(int index);

// NULL when there is none of that name.
const Material *builtin_material(const char *name);

#endif
