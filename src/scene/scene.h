// The scene file as a value: everything a picture is made from, read from YAML (libcyaml) and
// checked. Strict: unknown keys, wrong types and numbers out of range are errors with line, column
// and what would be right. All defaults stand in one set of tables (spec.h), from which the JSON
// Schema is printed too.
#ifndef RAMIFY_SCENE_SCENE_H
#define RAMIFY_SCENE_SCENE_H

#include "base/run.h"
#include "image/tonemap.h"
#include "model/coral.h"
#include "model/dla.h"
#include "model/forest.h"
#include "model/fracture.h"
#include "model/frost.h"
#include "model/ground.h"
#include "model/lightning.h"
#include "model/lsystem_plant.h"
#include "model/sculpture.h"
#include "model/terrain.h"
#include "model/tree.h"
#include "model/venation.h"
#include "model/vessels.h"
#include "render/world.h"

#include <stddef.h>

typedef struct SceneMesh { // an imported mesh that is drawn
    char *file;
    Transform transform;
    bool smooth; // make smooth normals when the file has none
} SceneMesh;

typedef struct SceneShape { // envelopes drawn as they are: spheres, boxes, ...
    Shape *shapes;
    int shape_count;
    float voxel;
} SceneShape;

// Exactly one of the kinds is not NULL.
typedef struct SceneObject {
    char *name;
    uint64_t seed; // 0 = from the scene's seed and the name
    TreeParams *tree;
    ForestParams *forest;
    CoralParams *coral;
    LSystemPlantParams *lsystem;
    VesselsParams *vessels;
    GroundParams *ground;
    FrostParams *frost;
    SceneMesh *mesh;
    SceneShape *shape;
    DlaModel *dla;
    LightningParams *lightning;
    SculptureParams *sculpture;
    TerrainParams *terrain;
    VenationParams *venation;
    FractureParams *fracture;
    // material names, as far as the kind has use for them; NULL = the kind's built-in default
    char *material; // mesh, shape, ground; bark of a tree
    char *twig_material, *leaf_material, *grass_material;
    char *water_material;                 // of terrain
    char *rime_material;                  // of frost
    char *polyp_material, *rock_material; // of corals
    char *vein_material;
    char *inside_material; // of what is broken
} SceneObject;

typedef struct SceneTarget { // what a scene says of its own result
    char *object, *measure;  // names
    double low, high;        // inclusive
} SceneTarget;

#define TARGET_NO_BOUND 1e300 // and beyond: that side is open

typedef struct Scene {
    char *file;     // where it was read from, for messages and to resolve relative paths
    char *text;     // the file's text, stored in images as metadata
    char *resolved; // the same as YAML with every default and override written out
    uint64_t seed;
    float grow_to; // 0..1: how much of all growth shows
    Camera camera;
    FilmParams film;
    ToneParams tone;
    bool denoise;
    RenderParams render;
    Sky sky;
    Medium *medium; // NULL = clear air
    Light *lights;
    int light_count;
    Material *materials;
    int material_count;
    SceneObject *objects;
    int object_count;
    SceneTarget *targets;
    int target_count;
} Scene;

// Reads and checks a scene. overrides: "path=value" strings (objects.0.tree.height=9, or
// objects.oak.tree.height=9 by name). Files named in the scene are found relative to it.
// ERROR_INPUT carries file, line and column.
Scene *scene_read(const char *file, const char *const *overrides, int override_count, Error *e);

// The same from text in memory. name stands for the file in messages; files named in the text are
// relative to folder ("" = the current one).
Scene *scene_read_text(const char *text, size_t length, const char *name, const char *folder,
                       const char *const *overrides, int override_count, Error *e);

void scene_free(Scene *scene); // NULL is fine

// JSON Schema of scene files (draft 2020-12) as heap text.
char *scene_schema_json(Error *e);

#endif
