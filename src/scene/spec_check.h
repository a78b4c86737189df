// Checks of whole mappings, for conditions on several keys; used by the tables of spec_*.c. See
// Table.check.
#ifndef RAMIFY_SCENE_SPEC_CHECK_H
#define RAMIFY_SCENE_SPEC_CHECK_H

#include "config/load.h"
#include "scene/scene.h"
#include "scene/spec.h"

typedef bool TableCheck(const Mapping *mapping, void *params);

TableCheck check_scene;  // names are unique, references exist
TableCheck check_camera; // also turns focal_length into fov
TableCheck check_film, check_render, check_light;
TableCheck check_target; // low <= high
TableCheck check_track;  // keys in order and of one type; stores line and column

#endif
