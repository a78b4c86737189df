// Built-in materials, available in every scene. A scene's material of the same name starts from the
// built-in one. So that no new one changes scenes that have a material of their own of that name,
// the names without a slash are complete (tests/scene/test_scene.c): a new one is called KIND/NAME,
// as "stone/gravel", which no other material can be.
#ifndef RAMIFY_SCENE_BUILTIN_H
#define RAMIFY_SCENE_BUILTIN_H

#include "render/material/material.h"

// Material number index: first those shared by several kinds, then each kind's own (Kind.builtin).
// NULL past the last one.
const Material *builtin_material_at(int index);

// NULL when there is none of that name.
const Material *builtin_material(const char *name);

#endif
