// The materials that every scene has without naming them.
#ifndef RAMIFY_SCENE_BUILTIN_H
#define RAMIFY_SCENE_BUILTIN_H

#include "render/material/material.h"

// Built-in materials as an array; *count of them: bark, twig, leaf, ground, grass, fallen, clay.
const Material *builtin_materials(int *count);

// NULL when there is none of that name.
const Material *builtin_material(const char *name);

#endif
