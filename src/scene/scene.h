// A scene: the checked contents of a scene file, from which an image is made. Reading is strict:
// unknown keys, wrong types and numbers out of range are errors that give line, column and the
// correction. One set of tables (spec.h) holds all keys and defaults; the JSON Schema is written
// from them, too.
#ifndef RAMIFY_SCENE_SCENE_H
#define RAMIFY_SCENE_SCENE_H

#include "base/run.h"
#include "image/tonemap.h"
#include "objects/kind.h"
#include "render/camera.h"
#include "render/film_params.h"
#include "render/rain/rain.h"
#include "render/render_params.h"
#include "render/sky/sky.h"

#include <stddef.h>
#include <string.h>

typedef struct SceneTarget { // required range of a measure
    char *object, *measure;  // names
    double low, high;        // inclusive
} SceneTarget;

typedef enum GoldenMode {
    GOLDEN_TOLERANCE,  // a PNG, equal within max_rmse and max_failing
    GOLDEN_EXACT,      // a PNG, equal to the bit
    GOLDEN_STATISTICAL // an EXR of means and variances, equal except for noise
} GoldenMode;

typedef struct SceneGolden { // how `ramify golden` compares the image with the stored one
    GoldenMode mode;
    double max_rmse, threshold, max_failing; // of display values; shares of 1
    double alpha;                            // GOLDEN_STATISTICAL: false alarm probability
    int runs;                                // GOLDEN_STATISTICAL: renderings per side
} SceneGolden;

#define TARGET_NO_BOUND 1e300 // at or beyond this: no bound on that side

// Interpolation between keys.
typedef enum Ease {
    EASE_LINEAR,
    EASE_SMOOTH, // slow at every key: smoothstep
    EASE_STEP,   // constant until the next key
    EASE_SPLINE  // smooth curve through the keys, without overshoot
} Ease;

enum { SCENE_KEY_MOST_NUMBERS = 16 }; // more than any value of a scene needs

typedef struct SceneKey {
    double at;   // time, 0..1 of the animation
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
    bool loop;       // frame number `frames` equals the first
    bool vary_noise; // new noise pattern in every frame
    SceneTrack *tracks;
    int track_count;
} SceneAnimation;

typedef struct Cloud Cloud;
typedef struct Light Light;
typedef struct Material Material;
typedef struct Medium Medium;

typedef enum SceneDenoiser {
    DENOISER_OWN,  // image/denoise.h
    DENOISER_OIDN, // image/oidn.h
    DENOISER_AUTO  // oidn if its library can be loaded, else own
} SceneDenoiser;

typedef struct Scene {
    Arena *arena;    // holds the scene itself and everything it points to but growths
    char *file;      // the scene file, for messages
    char *text;      // the file's text
    char *origin;    // text to store in pictures: of the scene file from which all began
    char *resolved;  // the scene as YAML with all defaults and overrides
    char *folder;    // base of relative paths in the text; "" = the current folder
    char *overrides; // overrides it was read with: "path=value\0 ... \0"
    uint64_t files;  // hash of names, sizes and times of the referenced files
    uint64_t seed;
    float grow_to; // 0..1: fraction of the growth that is shown
    Camera camera;
    FilmParams film;
    ToneParams tone;
    int png_depth;  // bits of a channel in PNGs: 8 or 16
    int downsample; // pixels of the film a side of a developed picture's pixel
    float sharpen;  // of the developed picture: factor on fine contrast beyond 1; 0 = none
    float grain;    // standard deviation of its display values at middle grey; 0 = none
    bool denoise;
    SceneDenoiser denoiser;
    RenderParams render;
    Sky sky;
    Medium *medium; // NULL = clear air
    Cloud *clouds;
    Shower *showers;
    int cloud_count, shower_count;
    Light *lights;
    Material *materials;
    int light_count, material_count;
    SceneObject *objects;
    int object_count;
    SceneTarget *targets;
    int target_count;
    SceneAnimation *animation; // NULL = a still
    SceneGolden golden;
    const struct Scene *whole; // full scene this subset came from; NULL if complete
    struct Growths *growths;   // of contests (scene/growths.h); filled as they are needed
} Scene;

// Reads and checks a scene, or the scene of a picture (.exr, .png) that was rendered of one.
// overrides: "path=value" strings (objects.0.tree.height=9, or
// objects.oak.tree.height=9 by name). Files named in the scene are found relative to it.
// ERROR_INPUT carries file, line and column.
Scene *scene_read(const char *file, const char *const *overrides, int override_count, Error *e);

// The same from text in memory. name stands for the file in messages; files named in the text are
// relative to folder ("" = the current one).
Scene *scene_read_text(const char *text, size_t length, const char *name, const char *folder,
                       const char *const *overrides, int override_count, Error *e);

// The settings of a picture, without the files that they name: to compare, to join and to develop
// films, not to grow or to render. origin: see Scene.origin; NULL = the text.
Scene *scene_read_settings(const char *text, const char *origin, const char *name,
                           const char *const *overrides, int override_count, Error *e);

// A new value, as YAML, for one key of a scene. line, column: place in the scene file, for
// messages; line 0: messages name `source` instead.
typedef struct SceneChange {
    const char *path, *value, *source;
    int line, column;
} SceneChange;

// Reads the scene again with changes in addition to its own overrides. Numbers are rounded for keys
// of whole numbers. ERROR_INPUT as for scene_read.
Scene *scene_changed(const Scene *scene, const SceneChange *changes, int count, Error *e);

void scene_free(Scene *scene); // NULL is fine

// Index of an object by name; -1 = not found.
int scene_find_object(const Scene *scene, const char *name);

// Name of the object whose surface the object grows over; NULL = none.
static inline const char *scene_object_over(const SceneObject *object)
{
    return object->kind->over ? object->kind->over(object->params) : NULL;
}

// Name of number i, from 0, of the objects that must be built before the object grows; NULL = there
// are no more.
static inline const char *scene_object_waits_for(const SceneObject *object, int i)
{
    return i < object->clear_of_count    ? object->clear_of[i].object
           : i == object->clear_of_count ? scene_object_over(object)
                                         : NULL;
}

// Does the object's growth depend on other objects?
static inline bool scene_object_has_neighbours(const SceneObject *object)
{
    return object->contest || scene_object_waits_for(object, 0);
}

// Do both belong to one contest?
static inline bool scene_objects_contend(const SceneObject *a, const SceneObject *b)
{
    return a->contest && b->contest && strcmp(a->contest->group, b->contest->group) == 0;
}

// Finds a material by name: the scene's own, else a built-in one; NULL = not found.
const Material *scene_material(const Scene *scene, const char *name);

// Gets the numbers of a key's value: one, those of a list, or the three of a colour in linear
// light. Returns their count; 0 = a word.
int scene_key_numbers(const SceneKey *key, double numbers[SCENE_KEY_MOST_NUMBERS]);

// Golden comparison of a scene that sets none.
SceneGolden scene_golden_default(void);

// JSON Schema of scene files (draft 2020-12) as heap text.
char *scene_schema_json(Error *e);

// Reference of scene files, docs/scene.md, as Markdown in heap text.
char *scene_schema_markdown(Error *e);

// Paths of all keys, as for --set, one per line: "objects.NAME.tree.height". Heap text.
char *scene_schema_paths(Error *e);

#endif
