// ramify's C API: the way from a scene file to out-trees, geometry, pictures and other programs'
// files. The ramify command is written on it alone.
//
// Conventions
// - Metres, degrees, Y up, right-handed, linear Rec. 709 colours, UTF-8.
// - Fallible functions return NULL or false and fill *error, which may be NULL. The message says
//   what is wrong and, after a semicolon, what would be right.
// - Handles are made by one function and freed by another (NULL is fine); different handles may be
//   used from different threads at the same time, one handle only to read.
// - Borrowed pointers live as long as the handle that gave them, and are not to be freed.
// - Structs are plain: fixed-size numbers and pointers. Those that go in may be all zero, which is
//   the usual way; those that come out are filled whole.
// - An index that is out of range is the caller's mistake and not checked, unless it says so.
// - The same scene and seed give the same bits for any number of threads.
//
// Link with -lramify (pkg-config ramify); docs/library.md is a guide, docs/examples/ has programs.
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

// Values of RamifyError.code.
enum {
    RAMIFY_OK = 0,
    RAMIFY_BAD_INPUT = 1, // the scene, a file it names, or an argument is wrong
    RAMIFY_IO = 2,        // the machine would not read or write
    RAMIFY_MEMORY = 3,    // out of memory
    RAMIFY_CANCELLED = 4, // by RamifyRun.cancelled
    RAMIFY_INTERNAL = 5,  // a library failed in a way that the input does not explain
    RAMIFY_DIFFERS = 6    // a result is not what it is held to
};

typedef struct RamifyError {
    int32_t code;
    int32_t line, column; // 1-based, in file; 0 = unknown
    char file[256];       // "" = unknown
    char message[768];
} RamifyError;

// Writes "file:line:column: message", as much of it as is known, into text of size bytes.
RAMIFY_API void ramify_error_format(const RamifyError *error, char *text, size_t size);

// How to run. {0} is fine: all processors, silent. The callbacks may come from any thread, one at a
// time, and from none after the call has returned.
typedef struct RamifyRun {
    int32_t threads;                                              // 0 = all processors
    const volatile int *cancelled;                                // set it to end early; or NULL
    void (*progress)(void *user, const char *stage, double done); // done in 0..1; or NULL
    void (*warn)(void *user, const char *message);                // or NULL
    void *user;
} RamifyRun;

// Largest resident set of this process so far, bytes.
RAMIFY_API int64_t ramify_memory_peak(void);

// Gives back memory that a function here says to give to it.
RAMIFY_API void ramify_free(void *memory);

// "did you mean": index of the known word nearest to word; -1 when none is near enough to be meant.
RAMIFY_API int ramify_nearest(const char *word, const char *const *known, int count);

// Writes "did you mean 'x'?" when a known word is near, else "known: a, b, c", into text of size
// bytes.
RAMIFY_API void ramify_suggest(const char *word, const char *const *known, int count, char *text,
                               size_t size);

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

typedef struct RamifySceneInfo {
    const char *file; // as it was named; borrowed
    uint64_t seed;
    int32_t width, height; // pixels
    float crop[4];         // x0, y0, x1, y1 in 0..1 from the top left; 0, 0, 1, 1 = all
    int32_t samples;       // a pixel
    int32_t denoise;       // 1 = written pictures are to be denoised
    double max_seconds;    // of tracing; 0 = no limit
    float max_noise;       // 0 = off
    float grow_to;         // 0..1: how much of all growth shows
    int32_t object_count, material_count, light_count, target_count;
    int64_t memory; // bytes that rendering takes in all, estimated from counts: about
                    // within a factor of 3, without level sets of envelopes
} RamifySceneInfo;

// What the scene says, without growing anything.
RAMIFY_API void ramify_scene_info(const RamifyScene *scene, RamifySceneInfo *info);

// The scene's text as it was read, without overrides; borrowed.
RAMIFY_API const char *ramify_scene_text(const RamifyScene *scene);

// The scene with every default and override written out, as YAML; borrowed.
RAMIFY_API const char *ramify_scene_resolved(const RamifyScene *scene);

// Objects, in the file's order. index is 0 .. count - 1; the name is borrowed.
RAMIFY_API int ramify_scene_object_count(const RamifyScene *scene);
RAMIFY_API const char *ramify_scene_object_name(const RamifyScene *scene, int index);

typedef struct RamifyObjectInfo {
    const char *name;   // borrowed
    const char *kind;   // "tree", "terrain", "ground", ...; static text
    uint64_t seed;      // its own, or made from the scene's and its name
    int32_t grows;      // 1 = ramify_grow works on it
    int32_t is_land;    // 1 = ramify_land works on it
    int32_t paints;     // 1 = ramify_paint works on it
    int64_t attractors; // asked for; 0 = none
    int64_t instances;  // leaves, tufts and other copies, at most; 0 = none
} RamifyObjectInfo;

// What the scene says of object number index.
RAMIFY_API void ramify_scene_object(const RamifyScene *scene, int index, RamifyObjectInfo *info);

// Writes what is worth knowing of the object beside its kind, such as ", 14 m, 4 levels" (begins
// with a comma, may be empty), into text of size bytes.
RAMIFY_API void ramify_scene_object_describe(const RamifyScene *scene, int index, char *text,
                                             size_t size);

// Name of material number index (0 .. RamifySceneInfo.material_count - 1); borrowed.
RAMIFY_API const char *ramify_scene_material_name(const RamifyScene *scene, int index);

// What a scene says of its own result: measure `measure` of object `object` lies in low .. high.
typedef struct RamifyTarget {
    const char *object, *measure; // names; borrowed
    double low, high;             // inclusive; -INFINITY and INFINITY where there is no bound
} RamifyTarget;

// Target number index (0 .. RamifySceneInfo.target_count - 1).
RAMIFY_API void ramify_scene_target(const RamifyScene *scene, int index, RamifyTarget *target);

// JSON Schema (draft 2020-12) of scene files; give it to ramify_free.
RAMIFY_API char *ramify_schema(RamifyError *error);

// The reference of scene files for readers, in Markdown; and the paths of all keys, one a line, as
// overrides take them: "objects.NAME.tree.height". Give them to ramify_free.
RAMIFY_API char *ramify_schema_markdown(RamifyError *error);
RAMIFY_API char *ramify_schema_paths(RamifyError *error);

// ---- growth ----

typedef struct RamifyTree RamifyTree; // an out-tree

// Grows object number index. RAMIFY_BAD_INPUT when that object does not grow (ground, mesh, shape)
// or does not exist. run may be NULL.
RAMIFY_API RamifyTree *ramify_grow(const RamifyScene *scene, int index, const RamifyRun *run,
                                   RamifyError *error);

// Reads an SWC file, coordinates in metres, in a child process with limits on time and memory: the
// file may be any. RAMIFY_BAD_INPUT with file and line when it is wrong. run may be NULL.
RAMIFY_API RamifyTree *ramify_tree_read(const char *file, const RamifyRun *run, RamifyError *error);

// Writes .swc, .json or .graphml by the file's ending. Written beside and renamed: a failure never
// harms an existing file.
RAMIFY_API bool ramify_tree_write(const RamifyTree *tree, const char *file, RamifyError *error);

RAMIFY_API void ramify_tree_free(RamifyTree *tree);

// Arrays of ramify_tree_count entries, borrowed.
RAMIFY_API int64_t ramify_tree_count(const RamifyTree *tree);
RAMIFY_API const float *ramify_tree_positions(const RamifyTree *tree); // 3 floats each, m

// Index of the parent, always smaller than the node's own, or -1 at a root.
RAMIFY_API const int32_t *ramify_tree_parents(const RamifyTree *tree);
RAMIFY_API const float *ramify_tree_radii(const RamifyTree *tree); // m

// Growth step, 0 for the nodes that growth began with.
RAMIFY_API const int32_t *ramify_tree_births(const RamifyTree *tree);

// Which root's colony, or which element (trunk, branches, roots), the node belongs to.
RAMIFY_API const int32_t *ramify_tree_colonies(const RamifyTree *tree);

// 3 floats each, unit: across the branch, or the surface's normal where growth is on a surface.
RAMIFY_API const float *ramify_tree_normals(const RamifyTree *tree);

// Stable names of the nodes: an edit elsewhere in the scene does not change them.
RAMIFY_API const uint64_t *ramify_tree_ids(const RamifyTree *tree);

// Box about the nodes, m: 3 floats each. low > high when there are none.
RAMIFY_API void ramify_tree_bounds(const RamifyTree *tree, float *low, float *high);

// A hash over positions, parents, births, colonies and radii: equal trees, equal hashes.
RAMIFY_API uint64_t ramify_tree_hash(const RamifyTree *tree);

// ---- land ----

typedef struct RamifyLand RamifyLand; // heights on a regular grid

// Heights of object number index, in its own space. tree: its out-tree from ramify_grow, or NULL to
// grow it on the way. RAMIFY_BAD_INPUT when the object is no land or does not exist. run may be
// NULL.
RAMIFY_API RamifyLand *ramify_land(const RamifyScene *scene, int index, const RamifyTree *tree,
                                   const RamifyRun *run, RamifyError *error);

// Reads an Esri ASCII grid (.asc); missing heights are NAN.
RAMIFY_API RamifyLand *ramify_land_read(const char *file, RamifyError *error);

RAMIFY_API void ramify_land_free(RamifyLand *land);

typedef struct RamifyLandInfo {
    int32_t columns, rows;
    float cell[2];   // m from sample to sample along x and z
    float origin[2]; // m: x and z of the first sample
    float low, high; // m: least and greatest height
    uint64_t hash;   // over sizes and heights
} RamifyLandInfo;

// Sizes, range and hash; looks at every height.
RAMIFY_API void ramify_land_info(const RamifyLand *land, RamifyLandInfo *info);

// columns * rows heights, m, row by row, x running fastest; borrowed.
RAMIFY_API const float *ramify_land_heights(const RamifyLand *land);

// Writes a 16-bit grey .png, black at the lowest and white at the highest point, a float .exr in
// metres (channel Y), or an Esri ASCII grid (.asc) in metres; ramify:low, ramify:high and
// ramify:cell in the metadata of pictures are metres.
RAMIFY_API bool ramify_land_write(const RamifyLand *land, const char *file, RamifyError *error);

// Draws what object number index makes (the veins of a leaf) as a picture of one value a pixel,
// 0..1: fills width * height floats row by row from the top left. tree: its out-tree from
// ramify_grow. RAMIFY_BAD_INPUT when the object makes no picture or does not exist.
RAMIFY_API bool ramify_paint(const RamifyScene *scene, int index, const RamifyTree *tree, int width,
                             int height, float *pixel, RamifyError *error);

// Writes such a picture as grey .png, .jpg or .exr.
RAMIFY_API bool ramify_paint_write(const float *pixel, int width, int height, const char *file,
                                   RamifyError *error);

// ---- measures ----

typedef struct RamifyMeasures RamifyMeasures; // a list of named numbers

// Measures object number index: its out-tree, and what its kind adds. What neither grows
// nor has measures of its kind is built: triangles, instances, materials, extents. RAMIFY_BAD_INPUT
// when it does not exist. run may be NULL.
RAMIFY_API RamifyMeasures *ramify_measure(const RamifyScene *scene, int index, const RamifyRun *run,
                                          RamifyError *error);

// What can be measured on any out-tree, and on any land.
RAMIFY_API RamifyMeasures *ramify_tree_measure(const RamifyTree *tree, RamifyError *error);
RAMIFY_API RamifyMeasures *ramify_land_measure(const RamifyLand *land, RamifyError *error);

RAMIFY_API void ramify_measures_free(RamifyMeasures *measures);

typedef struct RamifyMeasure {
    const char *name; // words joined by _ ("radius_exponent"); borrowed
    const char *unit; // "" = a plain number; static text
    double value;     // NAN = there is too little to measure
    double low, high; // nature's range as far as it is known; NAN = not
} RamifyMeasure;

// The measures, in the order in which they were made. index is 0 .. count - 1.
RAMIFY_API int ramify_measures_count(const RamifyMeasures *measures);
RAMIFY_API void ramify_measures_get(const RamifyMeasures *measures, int index,
                                    RamifyMeasure *measure);

// Index of the measure of this name; -1 when there is none.
RAMIFY_API int ramify_measures_find(const RamifyMeasures *measures, const char *name);

// ---- geometry ----

typedef struct RamifyWorld RamifyWorld; // all that is rendered: grown, skinned and placed

// Grows, skins and places everything. The world borrows from the scene: free it first. run may be
// NULL.
RAMIFY_API RamifyWorld *ramify_build(const RamifyScene *scene, const RamifyRun *run,
                                     RamifyError *error);
RAMIFY_API void ramify_world_free(RamifyWorld *world);

typedef struct RamifyWorldInfo {
    int64_t nodes;          // of all out-trees
    int64_t triangles;      // stored once; a quad counts as two
    int64_t curve_segments; // stored once
    int64_t instances;
    int64_t bytes; // of the geometry
    double grow_seconds, mesh_seconds;
} RamifyWorldInfo;

// How much was built, and how long it took.
RAMIFY_API void ramify_world_info(const RamifyWorld *world, RamifyWorldInfo *info);

// One mesh or one set of round curves. All pointers are borrowed from the world. Arrays that are
// not there are NULL.
typedef struct RamifyPart {
    int32_t object;          // index in the scene of what it belongs to
    int32_t face_size;       // corners a face, 3 or 4; 0 = curves, not a mesh
    const char *material;    // name
    int64_t vertex_count;    // of the mesh, or points of the curves
    const float *positions;  // vertex_count * 3, m
    const float *normals;    // vertex_count * 3, unit; NULL = flat shading, or curves
    const float *uvs;        // vertex_count * 2: m around and along on grown meshes, else 0..1
    const float *radii;      // vertex_count, m
    const float *births;     // vertex_count, 0..1 of the growth's time
    int64_t face_count;      // 0 for curves
    const uint32_t *indices; // face_count * face_size, counter-clockwise seen from outside
    int64_t curve_count;     // 0 for a mesh
    const int64_t *starts;   // curve_count + 1: curve i has the points starts[i] .. starts[i+1] - 1
    int64_t instance_count;  // 0 = drawn once, as it is
    const float *instances;  // instance_count * 12: rows of 3 x 4 matrices, column 4 the place, m
    const float *variations; // instance_count, 0..1, for variation of colour
} RamifyPart;

// The parts, in the order of the scene's objects. index is 0 .. count - 1.
RAMIFY_API int64_t ramify_world_part_count(const RamifyWorld *world);
RAMIFY_API void ramify_world_part(const RamifyWorld *world, int64_t index, RamifyPart *part);

// ---- export ----

// Values of RamifyExportOptions.instances: how formats that can keep instances write them.
enum {
    RAMIFY_INSTANCES_AUTO = 0,  // as the format does best (docs/formats.md)
    RAMIFY_INSTANCES_NODES = 1, // each names the same mesh
    RAMIFY_INSTANCES_GPU = 2,   // .glb: EXT_mesh_gpu_instancing
    RAMIFY_INSTANCES_FLAT = 3   // each a copy of the mesh
};

// Values of RamifyExportOptions.colors: what the colours of vertices show.
enum {
    RAMIFY_COLORS_ALL = 0,     // patterns, and growth as a second set where a format has two
    RAMIFY_COLORS_PATTERN = 1, // what procedural patterns look like
    RAMIFY_COLORS_GROWTH = 2,  // red: birth, 0..1; green: radius over the object's largest
    RAMIFY_COLORS_NONE = 3
};

// {0} is what is best for most.
typedef struct RamifyExportOptions {
    const char *const *objects; // names of the only objects to write
    int32_t object_count;       // 0 = all
    int32_t instances;          // RAMIFY_INSTANCES_...
    int32_t colors;             // RAMIFY_COLORS_...
    int32_t tube_sides;         // of curves written as tubes, 3..64; 0 = 6
} RamifyExportOptions;

// What was written, with instances written out and curves as tubes; 0 where a format has no
// surfaces.
typedef struct RamifyExportReport {
    int64_t vertices, triangles;
    float low[3], high[3]; // bounds, m
    int64_t bytes;         // of the file
} RamifyExportReport;

// Grows, skins and places what the format of the file's ending needs, and writes it. Written beside
// and renamed: a failure never harms an existing file. options, run and report may be NULL.
RAMIFY_API bool ramify_export(const RamifyScene *scene, const char *file,
                              const RamifyExportOptions *options, const RamifyRun *run,
                              RamifyExportReport *report, RamifyError *error);

// Writes what was grown from a scene already: trees[i] and lands[i] belong to object number i, NULL
// where there is none. Several trees go to FILE-OBJECT.swc (or .json) each, or to one .graphml;
// several lands to FILE-OBJECT.png (.exr, .asc) each. run may be NULL.
RAMIFY_API bool ramify_export_trees(const RamifyScene *scene, const RamifyTree *const *trees,
                                    const char *file, const RamifyRun *run, RamifyError *error);
RAMIFY_API bool ramify_export_lands(const RamifyScene *scene, const RamifyLand *const *lands,
                                    const char *file, const RamifyRun *run, RamifyError *error);

// RAMIFY_BAD_INPUT, naming the endings there are, when the file's ending is that of no format.
RAMIFY_API bool ramify_export_check(const char *file, RamifyError *error);

// The formats: ending (".glb") and a few words on each; static text.
RAMIFY_API int ramify_export_format_count(void);
RAMIFY_API const char *ramify_export_format_ending(int index);
RAMIFY_API const char *ramify_export_format_doc(int index);

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

// RAMIFY_BAD_INPUT or RAMIFY_IO when no picture could be written to such a file: its name has
// another ending, its folder is not there. For before the work.
RAMIFY_API bool ramify_image_check(const char *file, RamifyError *error);

// The same step by step, with previews and every layer of the film.

typedef struct RamifyFilm RamifyFilm;

// width, height: as ramify_scene_size says. Black until something is rendered.
RAMIFY_API RamifyFilm *ramify_film_new(int width, int height, RamifyError *error);
RAMIFY_API void ramify_film_free(RamifyFilm *film);

// A layer of the film, row by row from the top left, *channels (may be NULL) floats a pixel;
// borrowed. NULL when there is none of that name:
//   color 3     mean radiance, premultiplied       alpha 1     share that met something
//   albedo 3    of the first hit, 0..1             normal 3    of the first hit, mean, not unit
//   depth 1     m; INFINITY where nothing was hit  position 3  m, of the first hit
//   object 1    index of the object + 1, 0 = none  samples 1   taken
//   variance 1  of the mean luminance
RAMIFY_API const float *ramify_film_layer(const RamifyFilm *film, const char *name, int *channels);

// Copies color and alpha into rgba, 4 * width * height floats as of ramify_render.
RAMIFY_API void ramify_film_rgba(const RamifyFilm *film, float *rgba);

// Develops the film of this scene: fills rgba with 4 * width * height display values, 0..1 in sRGB,
// straight beside alpha, as they go to a screen. denoise: take the noise out first; run (may be
// NULL) is for that.
RAMIFY_API bool ramify_film_develop(const RamifyFilm *film, const RamifyScene *scene, bool denoise,
                                    float *rgba, const RamifyRun *run, RamifyError *error);

// Writes the film of this scene. .png, .jpg: developed, and with denoise the noise taken out first.
// .exr: linear RGBA and the layers albedo, normal, depth, position, object and samples as they are.
// The scene's text and settings go along as metadata. run (may be NULL) is for the denoiser.
RAMIFY_API bool ramify_film_write(const RamifyFilm *film, const RamifyScene *scene,
                                  const char *file, bool denoise, const RamifyRun *run,
                                  RamifyError *error);

typedef struct RamifyRenderer RamifyRenderer;

// RAMIFY_BAD_INPUT when isa is no instruction set that the ray tracer has on this machine. NULL is
// fine.
RAMIFY_API bool ramify_check_isa(const char *isa, RamifyError *error);

// Builds what rays are traced through. The world is borrowed: free the renderer first. isa: NULL =
// the best of this machine, or "sse4.2" (sse2, avx, avx2, avx512) to pin it, for the same bits on
// every machine. run may be NULL.
RAMIFY_API RamifyRenderer *ramify_renderer_new(const RamifyWorld *world, const char *isa,
                                               const RamifyRun *run, RamifyError *error);
RAMIFY_API void ramify_renderer_free(RamifyRenderer *renderer);

typedef struct RamifyRenderInfo {
    int64_t paths, rays;
    int64_t bytes;   // held by the renderer
    double seconds;  // of tracing
    int32_t samples; // taken a pixel, the least over all pixels; 0 = some have none
} RamifyRenderInfo;

// Called after every pass over the picture (1, 2, 4, ... samples) with the film so far.
typedef void (*RamifyPass)(void *user, const RamifyFilm *film, int samples);

// Renders into a film of the scene's size; what was in it is replaced, but for pixels outside the
// crop. pass may be NULL and is called with user. Out of time it leaves a whole picture of fewer
// samples and returns true; info->samples tells. Cancelled it does so too, at once: 0 samples means
// that some pixels were not reached and are black and transparent, and where none was reached it
// fails with RAMIFY_CANCELLED. info and run may be NULL.
RAMIFY_API bool ramify_renderer_render(RamifyRenderer *renderer, RamifyFilm *film, RamifyPass pass,
                                       void *user, const RamifyRun *run, RamifyRenderInfo *info,
                                       RamifyError *error);

// ---- golden images ----

// What two pictures may differ by and still be alike; negative = no such limit.
typedef struct RamifyLimits {
    double max_rmse;    // root mean square over all values
    double threshold;   // a pixel fails when a channel differs by more; negative = 0.012
    double max_failing; // share of pixels that may fail, 0..1
} RamifyLimits;

typedef struct RamifyDifference {
    int32_t alike;                     // 1 = within the limits
    int32_t width, height;             // pixels, of the first picture, or ours
    int32_t other_width, other_height; // when they differ, there are no numbers below
    double rmse, mean, maximum;        // over all values: display values 0..1, or radiance
    double failing;                    // share of pixels over the threshold, 0..1
    double psnr;                       // dB; INFINITY when equal
    double perceptual;                 // FLIP (Andersson et al. 2020), mean over pixels, 0..1
    int32_t worst_x, worst_y;          // pixel of the maximum, from the top left
    int32_t statistical;               // 1 = equal but for noise was asked; then also:
    double p;                          // least alpha at which any block would differ
    double z;                          // of the block that differs most surely
    int64_t tests, rejected;           // blocks times channels; how many differ
    char message[256];                 // why they are not alike; "" when they are
} RamifyDifference;

// Compares two picture files of any kind (PNG, JPEG, EXR, HDR, ...): their colour, over black, and
// alpha. Other sizes are a difference. limits: NULL = every value must be the same. report: HTML
// page to write, or NULL. RAMIFY_BAD_INPUT when a file cannot be read, or when one holds radiance
// and the other display values.
RAMIFY_API bool ramify_compare(const char *ours, const char *other, const RamifyLimits *limits,
                               const char *report, RamifyDifference *difference,
                               RamifyError *error);

// Values of RamifyGoldenScene.status.
enum {
    RAMIFY_GOLDEN_ALIKE = 0,
    RAMIFY_GOLDEN_DIFFERENT = 1,
    RAMIFY_GOLDEN_MISSING = 2, // no stored image
    RAMIFY_GOLDEN_FAILED = 3,  // the scene or its stored image is wrong, or rendering failed
    RAMIFY_GOLDEN_STORED = 4,  // by an update
    RAMIFY_GOLDEN_ORPHAN = 5   // a stored image without a scene
};

// "alike", "different", ...; static text.
RAMIFY_API const char *ramify_golden_status_name(int status);

// Values of RamifyGoldenOptions.mode.
enum {
    RAMIFY_GOLDEN_AS_SCENE = 0, // what the scene says
    RAMIFY_GOLDEN_TOLERANCE = 1,
    RAMIFY_GOLDEN_EXACT = 2,
    RAMIFY_GOLDEN_STATISTICAL = 3
};

typedef struct RamifyGoldenScene {
    const char *name;    // the scene's file without its ending; an orphan's with it
    const char *message; // what is wrong; "" = nothing
    int32_t status;
    const RamifyDifference *difference; // NULL = there was nothing to compare with
    const RamifyLimits *limits;         // what it was held to; negative = no limit
    double alpha;                       // chance of a false alarm, when statistical
    double seconds;
} RamifyGoldenScene;

typedef struct RamifyGoldenOptions {
    int32_t update;             // 1 = store what differs or is missing
    int32_t mode;               // for all scenes
    uint64_t series;            // statistical: another number, other seeds for our renderings
    const char *filter;         // names of scenes to take, with * and ?; NULL = all
    const char *isa;            // NULL = "sse4.2"; "native" = this machine's best
    const RamifyLimits *limits; // for all scenes, where not negative; NULL = the scenes' own
    const char *report;         // HTML page to write; NULL = none
    const char *junit;          // JUnit XML to write; NULL = none
    // After each scene; what it is given lives until it returns. NULL = not wanted.
    void (*each)(void *user, const RamifyGoldenScene *scene);
    void *user;
} RamifyGoldenOptions;

typedef struct RamifyGoldenCounts {
    int32_t alike, different, missing, failed, stored, orphans;
} RamifyGoldenCounts;

// Renders every scene of the folder, pinned (instruction set, seed, samples), and compares it with
// its stored image: NAME.yaml with NAME.png, or NAME.exr when statistical. What is wrong with one
// scene is part of its result. options: NULL = compare with the scenes' own limits. run may be
// NULL. RAMIFY_BAD_INPUT when the folder cannot be read or has no scenes.
RAMIFY_API bool ramify_golden(const char *folder, const RamifyGoldenOptions *options,
                              const RamifyRun *run, RamifyGoldenCounts *counts, RamifyError *error);

// ---- films ----

enum { RAMIFY_MOST_KEYS = 16 };

// Values at even steps of time; count 0 = none. When the last is the first, frame i of N shows the
// time i/N, so that the film loops without a jump; else i/(N-1), so that it ends on the last value.
typedef struct RamifyKeys {
    int32_t count; // at most RAMIFY_MOST_KEYS
    double value[RAMIFY_MOST_KEYS];
} RamifyKeys;

// Values of RamifyTurntable.ease.
enum { RAMIFY_EASE_USUAL = 0, RAMIFY_EASE_LINEAR = 1, RAMIFY_EASE_SMOOTH = 2 };

// What a film shows; all zero: the camera goes once around its target, or, where the scene has an
// `animation:`, that alone.
typedef struct RamifyTurntable {
    int32_t frames;       // 0 = as the scene's animation says, else 72
    double fps;           // frames a second; 0 likewise, else 24
    int32_t start, count; // render frames start .. start + count - 1 only; count 0 = to the last
    double turns;         // full circles, negative the other way; 0 = the usual
    int32_t still;        // 1 = no turn at all
    int32_t spin;         // 1 = everything but camera, sky and lamps turns, not the camera
    RamifyKeys elevation; // degrees of the camera above its target, -89 .. 89
    RamifyKeys dolly;     // factor on the camera's distance to its target
    RamifyKeys grow;      // how much of all growth shows, 0..1
    RamifyKeys sun;       // solar time, hours, at 48 degrees north in mid-May; south is +Z
    int32_t ease;         // usual: smooth for elevation and dolly, linear for the rest
    int32_t vary_noise;   // another pattern of noise a frame: 1 yes, -1 no, 0 as the scene says
    const char *isa;      // as for ramify_renderer_new
} RamifyTurntable;

typedef struct RamifyTurntableInfo {
    int32_t frames;            // of the whole film
    int32_t rendered, skipped; // in this call; skipped: they were there already
    int32_t geometries;        // how often something was grown or skinned
    int32_t structures;        // how often acceleration structures were built from nothing
    int64_t paths;
    double prepare_seconds, grow_seconds, mesh_seconds, build_seconds, trace_seconds;
    double finish_seconds; // spent waiting for pictures to be developed and written
    double video_seconds;
} RamifyTurntableInfo;

// The scene as it is at a time of the film, 0 .. 1: a scene of its own. turntable NULL = all zero.
// RAMIFY_BAD_INPUT names the line of the track that asks for what cannot be.
RAMIFY_API RamifyScene *ramify_scene_at(const RamifyScene *scene, const RamifyTurntable *turntable,
                                        double time, RamifyError *error);

// The same of frame number frame, 0 .. frames - 1.
RAMIFY_API RamifyScene *ramify_scene_at_frame(const RamifyScene *scene,
                                              const RamifyTurntable *turntable, int frame,
                                              RamifyError *error);

// Renders a film to file: "oak-%04d.png" (.png, .jpg or .exr, the frame's number where %04d is), or
// "oak.mp4" by ffmpeg (H.264, yuv420p, BT.709). What stays from frame to frame is grown, skinned
// and built once. Frames that are there, whole and made from the same settings, are skipped, so
// that a call that was interrupted goes on where it ended; those of a film wait in oak.mp4.frames.
// turntable NULL = all zero; info and run may be NULL. info is filled when it fails, too.
RAMIFY_API bool ramify_turntable(const RamifyScene *scene, const RamifyTurntable *turntable,
                                 const char *file, const RamifyRun *run, RamifyTurntableInfo *info,
                                 RamifyError *error);

// RAMIFY_BAD_INPUT or RAMIFY_IO when ramify_turntable could not write to such a file.
RAMIFY_API bool ramify_turntable_check(const char *file, RamifyError *error);

#ifdef __cplusplus
}
#endif

#endif
