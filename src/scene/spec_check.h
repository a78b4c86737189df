// Checks of whole mappings, named by the tables of spec_*.c: what no single key's range can say.
// See Table.check.
#ifndef RAMIFY_SCENE_SPEC_CHECK_H
#define RAMIFY_SCENE_SPEC_CHECK_H

#include "config/resolve.h"
#include "scene/scene.h"
#include "scene/spec.h"

// Defaults of mappings whose position, rotation and scale become one transform.
typedef struct PlacedShape {
    Shape shape;
    Vec3 position, rotation, scale;
} PlacedShape;

typedef struct PlacedMesh {
    SceneMesh mesh;
    Vec3 position, rotation, scale;
} PlacedMesh;

// Does an object's key name a material? Those that do end in "material".
bool is_material_key(const char *key);

typedef bool TableCheck(Resolver *r, const Path *path, const Node *given, Node *resolved);

// The whole scene: names are unique, materials that objects name exist.
TableCheck check_scene;
TableCheck check_camera; // also turns focal_length into fov
TableCheck check_film, check_light;
TableCheck check_target;                          // low <= high
TableCheck check_track;                           // keys in order and of one kind; adds its place
TableCheck check_object;                          // exactly one kind; material keys that suit it
TableCheck check_tree, check_ground, check_grove; // lengths that must be in order
TableCheck check_shape, check_mesh;               // also add `transform`
TableCheck check_vessels;                         // an envelope there must be
TableCheck check_envelope;                        // the list under `envelope`; points, sectors
TableCheck check_level, check_growth; // check_growth also fills in what levels leave out
TableCheck check_terrain;             // cells a power of two
TableCheck check_field;
TableCheck check_lsystem, check_coral; // grammars that can be read
TableCheck check_lightning;            // also what check_envelope does

#endif
