// ramify's C API: the way from a scene file to out-trees and pictures, for programs.
//
// Conventions
// - Metres, degrees, Y up, right-handed, linear Rec. 709 colours.
// - Fallible functions return NULL or false and fill *error, which may be NULL. The message says
//   what is wrong and, after a semicolon, what would be right.
// - Handles are made by one function and freed by another (NULL is fine); different handles may be
//   used from different threads at the same time, one handle only to read.
// - The same scene and seed give the same bits for any number of threads.
//
// Link with -lramify (pkg-config ramify).
#ifndef RAMIFY_H
#define RAMIFY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RAMIFY_VERSION "0.1.0"
#define RAMIFY_API __attribute__((visibility("default")))

// Version of the library at hand, as RAMIFY_VERSION; static text.
RAMIFY_API const char *ramify_version(void);

typedef enum RamifyErrorCode {
    RAMIFY_OK = 0,
    RAMIFY_BAD_INPUT, // the scene, or a file it names, is wrong
    RAMIFY_IO,        // the machine would not read or write
    RAMIFY_MEMORY,
    RAMIFY_CANCELLED,
    RAMIFY_INTERNAL
} RamifyErrorCode;

typedef struct RamifyError {
    RamifyErrorCode code;
    int line, column;  // 1-based, in file; 0 = unknown
    char file[256];    // "" = unknown
    char message[768]; // UTF-8
} RamifyError;

// Writes "file:line:column: message", as much of it as is known, into text of size bytes.
RAMIFY_API void ramify_error_format(const RamifyError *error, char *text, size_t size);

// How to run. {0} is fine: all processors, silent. The callbacks may come from any thread, one at a
// time.
typedef struct RamifyRun {
    int threads;                                                  // 0 = all processors
    const volatile int *cancelled;                                // set it to end early; or NULL
    void (*progress)(void *user, const char *stage, double done); // done in 0..1; or NULL
    void (*warn)(void *user, const char *message);                // or NULL
    void *user;
} RamifyRun;

// ---- scenes ----

typedef struct RamifyScene RamifyScene;

// Reads and checks a scene file. overrides: override_count texts "path=value" such as
// "camera.fov=35" or "objects.oak.tree.height=9"; may be NULL when there are none. Files that the
// scene names are relative to its folder and must exist.
RAMIFY_API RamifyScene *ramify_scene_load(const char *file, const char *const *overrides,
                                          int override_count, RamifyError *error);

// The same from length bytes of YAML. name stands for the file in messages; folder is what files
// named in the text are relative to, "" the current one.
RAMIFY_API RamifyScene *ramify_scene_load_text(const char *text, size_t length, const char *name,
                                               const char *folder, const char *const *overrides,
                                               int override_count, RamifyError *error);

RAMIFY_API void ramify_scene_free(RamifyScene *scene);

// Width and height of the picture, pixels.
RAMIFY_API void ramify_scene_size(const RamifyScene *scene, int *width, int *height);

// The scene with every default written out, as YAML; lives as long as the scene.
RAMIFY_API const char *ramify_scene_resolved(const RamifyScene *scene);

// Objects, in the file's order. index is 0 .. count - 1; the name lives as long as the scene.
RAMIFY_API int ramify_scene_object_count(const RamifyScene *scene);
RAMIFY_API const char *ramify_scene_object_name(const RamifyScene *scene, int index);

// JSON Schema (draft 2020-12) of scene files; give it to ramify_free.
RAMIFY_API char *ramify_schema(RamifyError *error);
RAMIFY_API void ramify_free(void *memory);

// ---- growth ----

typedef struct RamifyTree RamifyTree; // an out-tree

// Grows object number index. RAMIFY_BAD_INPUT when that object does not grow (ground, mesh, shape).
// run may be NULL.
RAMIFY_API RamifyTree *ramify_grow(const RamifyScene *scene, int index, const RamifyRun *run,
                                   RamifyError *error);
RAMIFY_API void ramify_tree_free(RamifyTree *tree);

// Arrays of ramify_tree_count entries (positions: 3 floats each, m; parents: index of the parent,
// always smaller than the node's own, or -1 at a root; radii: m; births: growth step, 0 for the
// nodes that growth began with). They live as long as the tree.
RAMIFY_API int64_t ramify_tree_count(const RamifyTree *tree);
RAMIFY_API const float *ramify_tree_positions(const RamifyTree *tree);
RAMIFY_API const int32_t *ramify_tree_parents(const RamifyTree *tree);
RAMIFY_API const float *ramify_tree_radii(const RamifyTree *tree);
RAMIFY_API const int32_t *ramify_tree_births(const RamifyTree *tree);

// ---- pictures ----

// Grows, skins and path traces the scene. rgba: room for 4 * width * height floats (see
// ramify_scene_size), filled row by row from the top left with linear radiance, premultiplied, and
// alpha. Cancelled while tracing it leaves a picture of fewer samples and returns true; *samples
// (may be NULL) tells how many each pixel has. run may be NULL.
RAMIFY_API bool ramify_render(const RamifyScene *scene, float *rgba, int *samples,
                              const RamifyRun *run, RamifyError *error);

// Writes such a picture: .png and .jpg developed by the scene's film (exposure, tone curve, ...),
// .exr linear. Written beside and renamed: a failure never harms an existing file.
RAMIFY_API bool ramify_write_image(const RamifyScene *scene, const float *rgba, const char *file,
                                   RamifyError *error);

#ifdef __cplusplus
}
#endif

#endif
