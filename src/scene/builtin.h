// Built-in materials, available in every scene.
#ifndef RAMIFY_SCENE_BUILTIN_H
#define RAMIFY_SCENE_BUILTIN_H

#include "render/material/material.h"

// Material number index: first those shared by several kinds, then each kind's own (Kind.builtin).
// NULL past the last one.
const Material *builtin_material_at(int index);

// NULL when there is none of that name.
const Material *builtin_material(const char *name);

#endif
