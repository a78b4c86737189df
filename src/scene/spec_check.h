// Checks of whole mappings, named by the tables of spec_*.c: what no single key's range can say.
// See Table.check.
#ifndef RAMIFY_SCENE_SPEC_CHECK_H
#define RAMIFY_SCENE_SPEC_CHECK_H

#include "config/load.h"
#include "objects/common/element.h"
#include "scene/scene.h"
#include "scene/spec.h"

typedef bool TableCheck(const Mapping *mapping, void *params);

TableCheck check_scene;  // names are unique, what they name exists
TableCheck check_camera; // also turns focal_length into fov
TableCheck check_film, check_light;
TableCheck check_target;              // low <= high
TableCheck check_track;               // keys in order and of one kind; notes its place
TableCheck check_shape;               // also makes its transform
TableCheck check_level, check_growth; // check_growth also fills in what levels leave out
TableCheck check_field;

// Parts of such checks.

// The list under `envelope`.
bool check_shapes(const Mapping *mapping, const Shape *shapes, int count);

// Envelope, points and growth of a mapping with ELEMENT_ROWS.
bool check_element(const Mapping *mapping, const ElementParams *element);

// What a look at a mesh file's name, size and header tells. path: under the mapping's key `file`.
bool check_mesh_file(const Mapping *mapping, const char *path);

// No factor of the mapping's `scale` is 0.
bool check_scale(const Mapping *mapping, Vec3 scale);

// An L-system's axiom and rules, as far as the file gives them (NULL = not).
bool check_grammar(const Mapping *mapping, const char *axiom, const char *rules);

#endif
