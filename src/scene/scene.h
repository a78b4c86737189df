// The scene file as a value: everything a picture is made from, read from YAML and checked. Strict:
// unknown keys, wrong types and numbers out of range are errors with line, column and what would be
// right. All defaults stand in one set of tables (spec.h), from which the JSON Schema is printed
// too.
#ifndef RAMIFY_SCENE_SCENE_H
#define RAMIFY_SCENE_SCENE_H

#include "base/run.h"
#include "image/tonemap.h"
#include "objects/kind.h"
#include "render/camera.h"
#include "render/film_params.h"
#include "render/render_params.h"
#include "render/sky/sky.h"

#include <stddef.h>

typedef struct SceneTarget { // what a scene says of its own result
    char *object, *measure;  // names
    double low, high;        // inclusive
} SceneTarget;

typedef enum GoldenMode {
    GOLDEN_TOLERANCE,  // a PNG, equal within max_rmse and max_failing
    GOLDEN_EXACT,      // a PNG, equal to the bit
    GOLDEN_STATISTICAL // an EXR of means and variances, equal but for noise
} GoldenMode;

typedef struct SceneGolden { // how `ramify golden` compares the scene with its stored image
    GoldenMode mode;
    double max_rmse, threshold, max_failing; // of display values; shares of 1
    double alpha;                            // GOLDEN_STATISTICAL: chance of a false alarm
    int runs;                                // GOLDEN_STATISTICAL: renderings a side
} SceneGolden;

#define TARGET_NO_BOUND 1e300 // and beyond: that side is open

// How a value goes from one key to the next.
typedef enum Ease {
    EASE_LINEAR,
    EASE_SMOOTH, // slow at every key: smoothstep
    EASE_STEP,   // stays until the next key
    EASE_SPLINE  // a smooth curve through the keys that never overshoots them
} Ease;

enum { SCENE_KEY_MOST_NUMBERS = 16 }; // more than any value of a scene has

typedef struct SceneKey {
    double at;   // 0..1, share of the animation
    char *value; // YAML: a number, a list of numbers, a colour, a word
    bool quoted; // in the file
} SceneKey;

typedef struct SceneTrack { // one value of the scene over time
    char *path;             // as in --set: camera.position, objects.oak.tree.height
    Ease ease;
    SceneKey *keys; // in order of time, all of one kind
    int key_count;
    int line, column; // in the scene's file; 0 = unknown
} SceneTrack;

typedef struct SceneAnimation {
    int frames;
    double fps;
    bool loop;       // frame number `frames` would be the first again
    bool vary_noise; // another pattern of noise in every frame
    SceneTrack *tracks;
    int track_count;
} SceneAnimation;

typedef struct Light Light;
typedef struct Material Material;
typedef struct Medium Medium;

typedef struct Scene {
    Arena *arena;    // of the scene itself and all that it points to
    char *file;      // where it was read from, for messages and to resolve relative paths
    char *text;      // the file's text, stored in images as metadata
    char *resolved;  // the same as YAML with every default and override written out
    char *folder;    // that files named in the text are relative to; "" = the current one
    char *overrides; // those it was read with: "path=value\0 ... \0"
    uint64_t files;  // hash of names, sizes and times of the files it names
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
    SceneAnimation *animation; // NULL = a still
    SceneGolden golden;
    const struct Scene *whole; // that this holds some of the objects of; NULL = it is all there is
} Scene;

// Reads and checks a scene. overrides: "path=value" strings (objects.0.tree.height=9, or
// objects.oak.tree.height=9 by name). Files named in the scene are found relative to it.
// ERROR_INPUT carries file, line and column.
Scene *scene_read(const char *file, const char *const *overrides, int override_count, Error *e);

// The same from text in memory. name stands for the file in messages; files named in the text are
// relative to folder ("" = the current one).
Scene *scene_read_text(const char *text, size_t length, const char *name, const char *folder,
                       const char *const *overrides, int override_count, Error *e);

// A value of the scene that shall be another one, as YAML. line, column: of the scene's file, for
// messages; line 0: messages name `source` instead.
typedef struct SceneChange {
    const char *path, *value, *source;
    int line, column;
} SceneChange;

// The scene anew with changes on top of its own overrides. Numbers are rounded where the key wants
// whole ones. ERROR_INPUT as for scene_read.
Scene *scene_changed(const Scene *scene, const SceneChange *changes, int count, Error *e);

void scene_free(Scene *scene); // NULL is fine

// The material of that name: the scene's own, else a built-in one; NULL = there is none.
const Material *scene_material(const Scene *scene, const char *name);

// The numbers of a key's value: one, those of a list, or the three of a colour in linear light.
// Their count; 0 = a word.
int scene_key_numbers(const SceneKey *key, double numbers[SCENE_KEY_MOST_NUMBERS]);

// What holds where a scene says nothing.
SceneGolden scene_golden_default(void);

// JSON Schema of scene files (draft 2020-12) as heap text.
char *scene_schema_json(Error *e);

// The reference of scene files, docs/scene.md, in Markdown as heap text.
char *scene_schema_markdown(Error *e);

// The paths of all keys as --set takes them, one a line: "objects.NAME.tree.height". Heap text.
char *scene_schema_paths(Error *e);

#endif
