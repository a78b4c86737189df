// ramify's C API: from scene files to out-trees, geometry, pictures and other programs' files. The
// ramify command uses only this API.
//
// Conventions
// - Metres, degrees, Y up, right-handed, linear Rec. 709 colours, UTF-8.
// - Fallible functions return NULL or false and fill *error, which may be NULL. The message says
//   what is wrong and, after a semicolon, what would be right.
// - Each handle is created by one function and freed by another (NULL is fine). Different handles
//   may be used concurrently from different threads; one handle only for reading.
// - Borrowed pointers are valid as long as the handle they come from, and must not be freed.
// - Structs are plain: fixed-size numbers and pointers. Input structs may be all zero for defaults;
//   output structs are filled completely.
// - Indices out of range are the caller's error and not checked, unless stated otherwise.
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

// Version of the linked library, as RAMIFY_VERSION; static text.
RAMIFY_API const char *ramify_version(void);

// Writes the compiler and the versions of the libraries that it was built with, "GCC 12.2.0, Embree
// 3.13.5, ...", into text of size bytes.
RAMIFY_API void ramify_libraries(char *text, size_t size);

// Values of RamifyError.code.
enum {
    RAMIFY_OK = 0,
    RAMIFY_BAD_INPUT = 1, // the scene, a file it names, or an argument is invalid
    RAMIFY_IO = 2,        // reading or writing failed
    RAMIFY_MEMORY = 3,    // out of memory
    RAMIFY_CANCELLED = 4, // cancelled by RamifyRun.cancelled
    RAMIFY_INTERNAL = 5,  // a library failed for reasons not in the input
    RAMIFY_DIFFERS = 6    // a result differs from what was required
};

typedef struct RamifyError {
    int32_t code;
    int32_t line, column; // 1-based, in file; 0 = unknown
    char file[256];       // "" = unknown
    char message[768];
} RamifyError;

// Writes "file:line:column: message", as far as known, into text of size bytes.
RAMIFY_API void ramify_error_format(const RamifyError *error, char *text, size_t size);

// Execution parameters; {0} = all processors, silent. Callbacks may be called from any thread, one
// at a time, and never after the function has returned.
typedef struct RamifyRun {
    int32_t threads; // 0 = all processors
    // set to non-zero to cancel; or NULL
    const volatile int *cancelled;
    void (*progress)(void *user, const char *stage, double done); // done in 0..1; or NULL
    void (*warn)(void *user, const char *message);                // or NULL
    void *user;
} RamifyRun;

// Largest resident set of this process so far, bytes.
RAMIFY_API int64_t ramify_memory_peak(void);

// Frees memory returned by functions that refer to ramify_free.
RAMIFY_API void ramify_free(void *memory);

// Index of the known word nearest to word, for "did you mean"; -1 if none is similar enough.
RAMIFY_API int ramify_nearest(const char *word, const char *const *known, int count);

// Writes "did you mean 'x'?" if a known word is similar, else "known: a, b, c", into text of size
// bytes.
RAMIFY_API void ramify_suggest(const char *word, const char *const *known, int count, char *text,
                               size_t size);

// ---- scenes ----

typedef struct RamifyScene RamifyScene;

// Reads and checks a scene file, or the scene of a picture (.exr, .png) that ramify has rendered;
// files that it names are then relative to the picture's folder. overrides: override_count texts
// "path=value" such as "camera.fov=35" or "objects.oak.tree.height=9"; may be NULL if there are
// none. Files named in the scene are relative to its folder and must exist.
RAMIFY_API RamifyScene *ramify_scene_load(const char *file, const char *const *overrides,
                                          int override_count, RamifyError *error);

// The same from length bytes of YAML. name replaces the file name in messages; files named in the
// text are relative to folder, "" = the current one.
RAMIFY_API RamifyScene *ramify_scene_load_text(const char *text, size_t length, const char *name,
                                               const char *folder, const char *const *overrides,
                                               int override_count, RamifyError *error);

// The settings of a picture (.exr, .png) that ramify has rendered, without the files that they
// name, which need not exist: to join and develop films, not to grow or to render.
RAMIFY_API RamifyScene *ramify_scene_load_settings(const char *picture,
                                                   const char *const *overrides, int override_count,
                                                   RamifyError *error);

RAMIFY_API void ramify_scene_free(RamifyScene *scene);

// Width and height of the picture, pixels.
RAMIFY_API void ramify_scene_size(const RamifyScene *scene, int *width, int *height);

typedef struct RamifySceneInfo {
    const char *file; // as passed to ramify_scene_load; borrowed
    uint64_t seed;
    int32_t width, height; // pixels
    float crop[4];         // x0, y0, x1, y1 in 0..1 from the top left; 0, 0, 1, 1 = all
    int32_t samples;       // per pixel
    int32_t denoise;       // 1 = written pictures should be denoised
    double max_seconds;    // of tracing; 0 = no limit
    float max_noise;       // 0 = off
    float grow_to;         // 0..1: share of the growth that is shown
    int32_t object_count, material_count, light_count, target_count;
    int64_t memory; // bytes needed for rendering, estimated from counts: about within a factor of
                    // 3, without level sets of envelopes
} RamifySceneInfo;

// Describes the scene without growing anything.
RAMIFY_API void ramify_scene_info(const RamifyScene *scene, RamifySceneInfo *info);

// Samples per pixel for which the pattern of the noise is laid out.
RAMIFY_API int ramify_scene_planned_samples(const RamifyScene *scene);

// The samples of each pixel that the scene takes: *first .. *end - 1 of *all (render.first_sample,
// render.end_sample, render.samples).
RAMIFY_API void ramify_scene_sample_range(const RamifyScene *scene, int *first, int *end, int *all);

// Frames of the scene's animation; 0 = it has none.
RAMIFY_API int ramify_scene_frames(const RamifyScene *scene);

// The scene's original text, without overrides; borrowed.
RAMIFY_API const char *ramify_scene_text(const RamifyScene *scene);

// The scene with all defaults and overrides written out, as YAML; borrowed.
RAMIFY_API const char *ramify_scene_resolved(const RamifyScene *scene);

// Objects, in the file's order. index is 0 .. count - 1; names are borrowed.
RAMIFY_API int ramify_scene_object_count(const RamifyScene *scene);
RAMIFY_API const char *ramify_scene_object_name(const RamifyScene *scene, int index);

typedef struct RamifyObjectInfo {
    const char *name;   // borrowed
    const char *kind;   // "tree", "terrain", "ground", ...; static text
    uint64_t seed;      // its own, or derived from the scene's and its name
    int32_t grows;      // 1 = supports ramify_grow
    int32_t is_land;    // 1 = supports ramify_land
    int32_t paints;     // 1 = supports ramify_paint
    int32_t tiles;      // a side of a terrain's world; 0 = ramify_land_tile is not supported
    int64_t attractors; // number requested; 0 = none
    int64_t instances;  // largest number of leaves, tufts and other copies; 0 = none
} RamifyObjectInfo;

// Describes object number index.
RAMIFY_API void ramify_scene_object(const RamifyScene *scene, int index, RamifyObjectInfo *info);

// Writes further details of the object, such as ", 14 m, 4 levels" (begins with a comma, may be
// empty), into text of size bytes.
RAMIFY_API void ramify_scene_object_describe(const RamifyScene *scene, int index, char *text,
                                             size_t size);

// Name of material number index (0 .. RamifySceneInfo.material_count - 1); borrowed.
RAMIFY_API const char *ramify_scene_material_name(const RamifyScene *scene, int index);

// A requirement in the scene: measure `measure` of object `object` must lie in low .. high.
typedef struct RamifyTarget {
    const char *object, *measure; // names; borrowed
    double low, high;             // inclusive; -INFINITY and INFINITY if unbounded
} RamifyTarget;

// Target number index (0 .. RamifySceneInfo.target_count - 1).
RAMIFY_API void ramify_scene_target(const RamifyScene *scene, int index, RamifyTarget *target);

// JSON Schema (draft 2020-12) of scene files; free with ramify_free.
RAMIFY_API char *ramify_schema(RamifyError *error);

// The reference of scene files in Markdown; and the paths of all keys, one per line, as used by
// overrides: "objects.NAME.tree.height". Free with ramify_free.
RAMIFY_API char *ramify_schema_markdown(RamifyError *error);
RAMIFY_API char *ramify_schema_paths(RamifyError *error);

// The built-in library of species, a line each: name, Latin name, form, height in metres, and the
// months in which leaves and organs are there. Free with ramify_free.
RAMIFY_API char *ramify_species(RamifyError *error);

// ---- growth ----

typedef struct RamifyTree RamifyTree; // an out-tree

// Grows object number index. RAMIFY_BAD_INPUT if the object does not grow (ground, mesh, shape) or
// does not exist. run may be NULL. Free with ramify_tree_free.
RAMIFY_API RamifyTree *ramify_grow(const RamifyScene *scene, int index, const RamifyRun *run,
                                   RamifyError *error);

// Reads an SWC file or, if it ends in .qsm, .txt or .csv, TreeQSM's table of cylinders (see
// docs/formats.md), coordinates in metres, in a child process with limits on time and memory, so
// that untrusted files are safe. RAMIFY_BAD_INPUT with file and line if it is invalid. run may be
// NULL.
RAMIFY_API RamifyTree *ramify_tree_read(const char *file, const RamifyRun *run, RamifyError *error);

// Writes .swc, .json or .graphml by the file's extension. Written to a temporary name and renamed:
// a failure leaves an existing file unchanged.
RAMIFY_API bool ramify_tree_write(const RamifyTree *tree, const char *file, RamifyError *error);

RAMIFY_API void ramify_tree_free(RamifyTree *tree);

// Arrays of ramify_tree_count entries, borrowed.
RAMIFY_API int64_t ramify_tree_count(const RamifyTree *tree);
RAMIFY_API const float *ramify_tree_positions(const RamifyTree *tree); // 3 floats each, m

// Index of the parent, always less than the node's own, or -1 at a root.
RAMIFY_API const int32_t *ramify_tree_parents(const RamifyTree *tree);
RAMIFY_API const float *ramify_tree_radii(const RamifyTree *tree); // m

// Growth step, 0 for initial nodes.
RAMIFY_API const int32_t *ramify_tree_births(const RamifyTree *tree);

// Colony (of a root) or element (trunk, branches, roots) that the node belongs to.
RAMIFY_API const int32_t *ramify_tree_colonies(const RamifyTree *tree);

// 3 floats each, unit: perpendicular to the branch, or the surface normal for growth on a surface.
RAMIFY_API const float *ramify_tree_normals(const RamifyTree *tree);

// Stable node identifiers, which do not change with edits elsewhere in the scene.
RAMIFY_API const uint64_t *ramify_tree_ids(const RamifyTree *tree);

// Bounding box of the nodes, m: 3 floats each. low > high if there are none.
RAMIFY_API void ramify_tree_bounds(const RamifyTree *tree, float *low, float *high);

// Hash of positions, parents, births, colonies and radii.
RAMIFY_API uint64_t ramify_tree_hash(const RamifyTree *tree);

// ---- land ----

typedef struct RamifyLand RamifyLand; // heights on a regular grid

// Heights of object number index, in its own space. tree: its out-tree from ramify_grow, or NULL to
// grow it here. RAMIFY_BAD_INPUT if the object is not land or does not exist. run may be NULL. Free
// with ramify_land_free.
RAMIFY_API RamifyLand *ramify_land(const RamifyScene *scene, int index, const RamifyTree *tree,
                                   const RamifyRun *run, RamifyError *error);

// Reads an Esri ASCII grid (.asc); missing heights are NAN.
RAMIFY_API RamifyLand *ramify_land_read(const char *file, RamifyError *error);

RAMIFY_API void ramify_land_free(RamifyLand *land);

typedef struct RamifyLandInfo {
    int32_t columns, rows;
    float cell[2];   // m, sample spacing along x and z
    float origin[2]; // m: x and z of the first sample
    float low, high; // m: lowest and highest height
    uint64_t hash;   // of sizes and heights
} RamifyLandInfo;

// Sizes, range and hash; takes time proportional to the number of heights.
RAMIFY_API void ramify_land_info(const RamifyLand *land, RamifyLandInfo *info);

// A map of the land in the same place and samples, its values in the place of heights: "slope"
// (degrees), "aspect" (degrees from north by east toward which the land falls, -1 where it is
// level), "curvature" (1/m, positive in hollows), "flow" (catchment, m^2), "wetness"
// (topographic index), "river-distance" (m), "deposit" and "wear" (m that erosion has laid down
// and taken away), "bedrock" (0..1: 1 = bare rock), "snow" (0..1 of the ground), "lava" (0..1: 1
// = just laid), "scoria" (0..1: red with oxide), "age" (0..1: of the ground of a braided river's
// valley), "water-depth" (m, negative above the water), "sun-hours" (a day, with the shade of the
// land; the year's mean at 45 degrees north, or as "sun-hours:LATITUDE:DAY", day 1 = 1 January) or
// "altitude" (m).
// RAMIFY_BAD_INPUT for another name, and for a map that this land does not have: only a terrain's
// own heights know of erosion, rock, lava and snow. Free with ramify_land_free.
RAMIFY_API RamifyLand *ramify_land_map(const RamifyLand *land, const char *name,
                                       RamifyError *error);

// Tile (column, row), from the north-west corner, of the terrain that is object number index, whose
// key `tiles` cuts it: finer ground than `world`, the land of the same object. Every tile is made
// alone; neighbours share the samples at their border, with the same bits. map: NULL for heights,
// or as in ramify_land_map. RAMIFY_BAD_INPUT if there is no such tile or map. run may be NULL. Free
// with ramify_land_free.
RAMIFY_API RamifyLand *ramify_land_tile(const RamifyScene *scene, int index,
                                        const RamifyLand *world, const char *map, int column,
                                        int row, const RamifyRun *run, RamifyError *error);

// columns * rows heights, m, row by row, x fastest; borrowed.
RAMIFY_API const float *ramify_land_heights(const RamifyLand *land);

// Writes a 16-bit grey .png, black at the lowest and white at the highest point, a float .exr in
// metres (channel Y), an Esri ASCII grid (.asc) in metres, or a GeoTIFF (.tif) of 32-bit floats, in
// the reference system of the survey that the land comes from or in a local one of metres.
// ramify:low, ramify:high and ramify:cell in the metadata of pictures are metres.
RAMIFY_API bool ramify_land_write(const RamifyLand *land, const char *file, RamifyError *error);

// Draws object number index (the veins of a leaf) as a picture of one value per pixel, 0..1: fills
// width * height floats row by row from the top left. tree: its out-tree from ramify_grow.
// RAMIFY_BAD_INPUT if the object has no picture or does not exist.
RAMIFY_API bool ramify_paint(const RamifyScene *scene, int index, const RamifyTree *tree, int width,
                             int height, float *pixel, RamifyError *error);

// Writes such a picture as grey .png, .jpg or .exr.
RAMIFY_API bool ramify_paint_write(const float *pixel, int width, int height, const char *file,
                                   RamifyError *error);

// ---- measures ----

typedef struct RamifyMeasures RamifyMeasures; // a list of named numbers

// Measures object number index: its out-tree, and measures specific to its kind. Objects with
// neither are built and measured by triangles, instances, materials and extents. RAMIFY_BAD_INPUT
// if the object does not exist. run may be NULL. Free with ramify_measures_free.
RAMIFY_API RamifyMeasures *ramify_measure(const RamifyScene *scene, int index, const RamifyRun *run,
                                          RamifyError *error);

// Measures several objects; quicker than one by one where they stand on the same land.
// wanted: ramify_scene_object_count entries; NULL = all. measures: as many entries, each to be
// freed; NULL where not wanted, and all of them after a failure.
RAMIFY_API bool ramify_measure_objects(const RamifyScene *scene, const bool *wanted,
                                       RamifyMeasures **measures, const RamifyRun *run,
                                       RamifyError *error);

// Measures of any out-tree, and of any land.
RAMIFY_API RamifyMeasures *ramify_tree_measure(const RamifyTree *tree, RamifyError *error);
RAMIFY_API RamifyMeasures *ramify_land_measure(const RamifyLand *land, RamifyError *error);

RAMIFY_API void ramify_measures_free(RamifyMeasures *measures);

typedef struct RamifyMeasure {
    const char *name; // words joined by _ ("radius_exponent"); borrowed
    const char *unit; // "" = a plain number; static text
    double value;     // NAN = not measurable
    double low, high; // range found in nature; NAN = unknown
} RamifyMeasure;

// The measures, in fixed order. index is 0 .. count - 1.
RAMIFY_API int ramify_measures_count(const RamifyMeasures *measures);
RAMIFY_API void ramify_measures_get(const RamifyMeasures *measures, int index,
                                    RamifyMeasure *measure);

// Index of the measure with this name; -1 if there is none.
RAMIFY_API int ramify_measures_find(const RamifyMeasures *measures, const char *name);

// ---- fitting ----

typedef struct RamifyFit RamifyFit; // the way of a search for parameters

// A number of the scene to vary: path as for overrides, "objects.oak.tree.height".
typedef struct RamifyRange {
    const char *path;
    double low, high;    // low < high, within what the key allows
    int32_t logarithmic; // 1 = equal steps are equal factors; low > 0
} RamifyRange;

// Values of RamifyFitOptions.until.
enum {
    RAMIFY_UNTIL_TARGETS = 0,    // stop at the first scene that meets all targets
    RAMIFY_UNTIL_EVALUATIONS = 1 // use all evaluations: measures move toward the middle of ranges
};

typedef struct RamifyFitOptions {
    const RamifyRange *ranges; // range_count, 1 to 32
    int32_t range_count;
    int32_t evaluations; // most scenes to grow; 0 = 64
    int32_t until;
    // told after each evaluation, from the calling thread, or NULL; the fit is for reading in it
    void (*evaluated)(void *user, const RamifyFit *fit);
    void *user;
} RamifyFitOptions;

// Searches values within the ranges with which the scene's measures meet its targets: around the
// scene's own values, then in the whole ranges, then around the best found, by the algorithms
// COBYLA, DIRECT-L and Sbplx of NLopt. Grows and measures what the targets name; renders nothing.
// RAMIFY_BAD_INPUT for an unknown path, a range that the key does not allow, a scene without
// targets, or a target that cannot be measured. Cancelled after the first evaluation, it returns
// what it has found. The scene must live as long as the fit. run may be NULL.
RAMIFY_API RamifyFit *ramify_fit(const RamifyScene *scene, const RamifyFitOptions *options,
                                 const RamifyRun *run, RamifyError *error);
RAMIFY_API void ramify_fit_free(RamifyFit *fit);

typedef struct RamifyFitInfo {
    int32_t evaluation_count;
    int32_t range_count, target_count;
    int32_t best;      // index of the best evaluation
    int32_t met;       // 1 = it meets all targets
    int32_t cancelled; // 1 = the search was interrupted
} RamifyFitInfo;

// What the search did and found.
RAMIFY_API void ramify_fit_info(const RamifyFit *fit, RamifyFitInfo *info);

typedef struct RamifyEvaluation {
    const double *parameters; // range_count values; borrowed
    const double *measures;   // target_count values, NAN = not measurable; borrowed
    double misfit;       // 0 = all targets met; grows with the distances from their ranges, in half
                         // widths; INFINITY if the scene could not be grown
    const char *failure; // why it could not be grown, or NULL; borrowed
} RamifyEvaluation;

// Evaluation number index, 0 .. evaluation_count - 1.
RAMIFY_API void ramify_fit_evaluation(const RamifyFit *fit, int index,
                                      RamifyEvaluation *evaluation);

// Writes the scene's file with the parameters of the best evaluation in place. *whole (may be
// NULL): false if comments and layout could not be kept, because a value comes from an alias, say;
// the file then has all values written out. Files that the scene names are relative to the new
// file's folder.
RAMIFY_API bool ramify_fit_write(const RamifyFit *fit, const char *file, bool *whole,
                                 RamifyError *error);

// Draws misfit, parameters and measures over the evaluations: .svg.
RAMIFY_API bool ramify_fit_draw(const RamifyFit *fit, const char *file, RamifyError *error);

// ---- geometry ----

typedef struct RamifyWorld RamifyWorld; // everything that is rendered: grown, skinned and placed

// Grows, skins and places everything. The world borrows the scene: free the world first. run may be
// NULL.
RAMIFY_API RamifyWorld *ramify_build(const RamifyScene *scene, const RamifyRun *run,
                                     RamifyError *error);
RAMIFY_API void ramify_world_free(RamifyWorld *world);

typedef struct RamifyWorldInfo {
    int64_t nodes;          // total of all out-trees
    int64_t triangles;      // counted once per part; a quad counts as two
    int64_t curve_segments; // counted once per part
    int64_t instances;
    int64_t bytes; // of the geometry
    double grow_seconds, mesh_seconds;
} RamifyWorldInfo;

// Size of the world, and the time it took to build.
RAMIFY_API void ramify_world_info(const RamifyWorld *world, RamifyWorldInfo *info);

// Chooses the part of the picture that renderers of the world trace from now on, as film.crop does:
// x0, y0, x1, y1 in 0..1 from the top left. RAMIFY_BAD_INPUT when it holds no pixel. No renderer
// may be rendering meanwhile.
RAMIFY_API bool ramify_world_crop(RamifyWorld *world, const float crop[4], RamifyError *error);

// Chooses the samples that renderers of the world take of each pixel from now on, as
// render.first_sample and render.end_sample do: first .. end - 1. RAMIFY_BAD_INPUT unless 0 <=
// first < end <= render.samples, or when the scene limits noise or time. No renderer may be
// rendering meanwhile.
RAMIFY_API bool ramify_world_samples(RamifyWorld *world, int first, int end, RamifyError *error);

// One mesh or one set of round curves. All pointers are borrowed from the world; absent arrays are
// NULL.
typedef struct RamifyPart {
    int32_t object;          // index of its object in the scene
    int32_t face_size;       // vertices per face, 3 or 4; 0 = curves, not a mesh
    const char *material;    // name
    int64_t vertex_count;    // of the mesh, or points of the curves
    const float *positions;  // vertex_count * 3, m
    const float *normals;    // vertex_count * 3, unit; NULL = flat shading, or curves
    const float *uvs;        // vertex_count * 2: m, around and along on grown meshes, else 0..1
    const float *radii;      // vertex_count, m
    const float *births;     // vertex_count, 0..1 of the growth
    int64_t face_count;      // 0 for curves
    const uint32_t *indices; // face_count * face_size, counter-clockwise seen from outside
    int64_t curve_count;     // 0 for a mesh
    const int64_t *starts;   // curve_count + 1: curve i has the points starts[i] .. starts[i+1] - 1
    int64_t instance_count;  // 0 = drawn once, untransformed
    const float *instances;  // instance_count * 12: rows of 3 x 4 matrices, column 4 the
                             // translation, m
    const float *variations; // instance_count, 0..1, for colour variation
} RamifyPart;

// The parts, in the order of the scene's objects. index is 0 .. count - 1.
RAMIFY_API int64_t ramify_world_part_count(const RamifyWorld *world);
RAMIFY_API void ramify_world_part(const RamifyWorld *world, int64_t index, RamifyPart *part);

// ---- export ----

// Values of RamifyExportOptions.instances: how formats with instances write them.
enum {
    RAMIFY_INSTANCES_AUTO = 0,  // best for the format (docs/formats.md)
    RAMIFY_INSTANCES_NODES = 1, // nodes that share a mesh
    RAMIFY_INSTANCES_GPU = 2,   // .glb: EXT_mesh_gpu_instancing
    RAMIFY_INSTANCES_FLAT = 3   // copies of the mesh
};

// Values of RamifyExportOptions.colors: contents of vertex colours.
enum {
    RAMIFY_COLORS_ALL = 0,     // patterns, and growth as a second set if the format has two
    RAMIFY_COLORS_PATTERN = 1, // procedural patterns
    RAMIFY_COLORS_GROWTH = 2,  // red: birth, 0..1; green: radius relative to the object's largest
    RAMIFY_COLORS_NONE = 3
};

// {0} suits most uses.
typedef struct RamifyExportOptions {
    const char *const *objects; // names of the only objects to write
    int32_t object_count;       // 0 = all
    int32_t instances;          // RAMIFY_INSTANCES_...
    int32_t colors;             // RAMIFY_COLORS_...
    int32_t tube_sides;         // of curves written as tubes, 3..64; 0 = 6
} RamifyExportOptions;

// What was written, with instances expanded and curves as tubes; 0 if the format has no surfaces.
typedef struct RamifyExportReport {
    int64_t vertices, triangles;
    float low[3], high[3]; // bounds, m
    int64_t bytes;         // of the file
} RamifyExportReport;

// Grows, skins and places what the format of the file's extension needs, and writes it. Written to
// a temporary name and renamed: a failure leaves an existing file unchanged. options, run and
// report may be NULL.
RAMIFY_API bool ramify_export(const RamifyScene *scene, const char *file,
                              const RamifyExportOptions *options, const RamifyRun *run,
                              RamifyExportReport *report, RamifyError *error);

// Writes results already grown from a scene: trees[i] and lands[i] belong to object number i, or
// are NULL. Several trees go to one FILE-OBJECT.swc (or .json) each, or to a single .graphml;
// several lands to one FILE-OBJECT.png (.exr, .asc, .tif) each. run may be NULL.
RAMIFY_API bool ramify_export_trees(const RamifyScene *scene, const RamifyTree *const *trees,
                                    const char *file, const RamifyRun *run, RamifyError *error);
RAMIFY_API bool ramify_export_lands(const RamifyScene *scene, const RamifyLand *const *lands,
                                    const char *file, const RamifyRun *run, RamifyError *error);

// RAMIFY_BAD_INPUT, listing the known extensions, if the file's extension is not that of a format.
RAMIFY_API bool ramify_export_check(const char *file, RamifyError *error);

// The formats: extension (".glb") and a short description; static text.
RAMIFY_API int ramify_export_format_count(void);
RAMIFY_API const char *ramify_export_format_ending(int index);
RAMIFY_API const char *ramify_export_format_doc(int index);

// ---- pictures ----

// Grows, skins and path traces the scene. rgba: 4 * width * height floats (see ramify_scene_size),
// filled row by row from the top left with linear radiance, premultiplied, and alpha. If cancelled
// while tracing, it leaves a picture of fewer samples and returns true; *samples (may be NULL) is
// set to the samples per pixel. run may be NULL.
RAMIFY_API bool ramify_render(const RamifyScene *scene, float *rgba, int *samples,
                              const RamifyRun *run, RamifyError *error);

// Writes such a picture: .png and .jpg developed with the scene's film settings (exposure, tone
// curve, ...), .exr linear. Written to a temporary name and renamed: a failure leaves an existing
// file unchanged.
RAMIFY_API bool ramify_write_image(const RamifyScene *scene, const float *rgba, const char *file,
                                   RamifyError *error);

// Checks in advance that a picture can be written to the file: RAMIFY_BAD_INPUT for an unknown
// extension, or if the plug-in that writes pictures is missing, RAMIFY_IO if its folder is missing.
RAMIFY_API bool ramify_image_check(const char *file, RamifyError *error);

// Checks in advance that the scene's film can be developed: RAMIFY_BAD_INPUT if it is denoised,
// film.denoiser is oidn and the library of Open Image Denoise cannot be loaded, or if film.color is
// no view of its OpenColorIO configuration.
RAMIFY_API bool ramify_develop_check(const RamifyScene *scene, RamifyError *error);

// The same step by step, with previews and every layer of the film.

typedef struct RamifyFilm RamifyFilm;

// width, height: as from ramify_scene_size. Black until rendered.
RAMIFY_API RamifyFilm *ramify_film_new(int width, int height, RamifyError *error);
RAMIFY_API void ramify_film_free(RamifyFilm *film);

// Reads the film of an .exr of this scene, to go on rendering it (ramify_renderer_resume).
// RAMIFY_BAD_INPUT when the file cannot be read, or when it is no picture of this scene: only the
// numbers of samples and seconds may differ. run may be NULL.
RAMIFY_API RamifyFilm *ramify_film_read(const char *file, const RamifyScene *scene,
                                        const RamifyRun *run, RamifyError *error);

// Joins pictures of parts of a scene's picture (film.crop) in a new film: pixels that have samples
// in one of the files. files: count names of .exr. RAMIFY_BAD_INPUT as for ramify_film_read, and
// when two of them have samples in the same pixel. *missing (may be NULL): pixels without samples
// in any.
RAMIFY_API RamifyFilm *ramify_film_join(const char *const *files, int count,
                                        const RamifyScene *scene, int64_t *missing,
                                        const RamifyRun *run, RamifyError *error);

// A layer of the film, row by row from the top left, *channels (may be NULL) floats a pixel;
// borrowed. NULL if there is no layer with that name:
//   color 3     mean radiance, premultiplied       alpha 1     share covered by surfaces
//   albedo 3    0..1                               normal 3    mean, not unit
//               (both of the first surface that scatters: in a mirror, of what the mirror shows)
//   depth 1     m; INFINITY where nothing was hit  position 3  m, of the first hit
//   object 1    index of the object + 1, 0 = none  samples 1   taken
//   variance 1  of the mean luminance              denoised 3  color as ramify_film_denoise left it
RAMIFY_API const float *ramify_film_layer(const RamifyFilm *film, const char *name, int *channels);

// Copies color and alpha into rgba, 4 * width * height floats as in ramify_render.
RAMIFY_API void ramify_film_rgba(const RamifyFilm *film, float *rgba);

// Removes the noise of the film of this scene by film.denoiser: makes the layer `denoised`, which
// the functions below then use in place of a denoising of their own. The layer goes when the film
// is rendered again. There is none if pixels of the scene's crop have no sample, because the first
// pass was cancelled. run may be NULL.
RAMIFY_API bool ramify_film_denoise(RamifyFilm *film, const RamifyScene *scene,
                                    const RamifyRun *run, RamifyError *error);

// Develops the film of this scene: fills rgba with 4 * width * height display values, 0..1, in sRGB
// or as the view of film.color has them, with straight alpha. denoise: remove the noise first, on
// the condition of ramify_film_denoise; run (may be NULL) applies to that.
RAMIFY_API bool ramify_film_develop(const RamifyFilm *film, const RamifyScene *scene, bool denoise,
                                    float *rgba, const RamifyRun *run, RamifyError *error);

// The noise that the film of this scene has when it is developed, before denoising, as a share of
// white: the standard error of the display values, mean over channels and pixels of the crop, as if
// samples were independent. NAN if no pixel has two samples.
RAMIFY_API bool ramify_film_noise(const RamifyFilm *film, const RamifyScene *scene, double *noise,
                                  RamifyError *error);

// Writes the film of this scene. .png, .jpg: developed as by ramify_film_develop. .exr: linear
// RGBA and the layers albedo, normal, depth, position, object and samples unchanged, and with
// denoise the layer denoised.R, G, B. The scene's text and settings are stored as metadata. run
// (may be NULL) applies to the denoiser.
RAMIFY_API bool ramify_film_write(const RamifyFilm *film, const RamifyScene *scene,
                                  const char *file, bool denoise, const RamifyRun *run,
                                  RamifyError *error);

// Writes an .exr of the pixels of the scene's crop (film.crop) alone, which is their data window in
// the display window of the picture: a part, for ramify_film_join, or to go on with by
// ramify_film_read. Not denoised.
RAMIFY_API bool ramify_film_write_part(const RamifyFilm *film, const RamifyScene *scene,
                                       const char *file, RamifyError *error);

typedef struct RamifyRenderer RamifyRenderer;

// RAMIFY_BAD_INPUT if this machine does not support the instruction set isa. NULL is fine.
RAMIFY_API bool ramify_check_isa(const char *isa, RamifyError *error);

// Builds the acceleration structures and lights. The world is borrowed: free the renderer first.
// isa: NULL = the best of this machine, or "sse4.2" (sse2, avx, avx2, avx512) to get the same bits
// on every machine. run may be NULL.
RAMIFY_API RamifyRenderer *ramify_renderer_new(const RamifyWorld *world, const char *isa,
                                               const RamifyRun *run, RamifyError *error);
RAMIFY_API void ramify_renderer_free(RamifyRenderer *renderer);

// What rendering a scene will take. Times are processor seconds of all threads and child processes
// of this machine.
typedef struct RamifyEstimate {
    int64_t memory;         // bytes resident at most, with what the process holds by now
    int64_t paths;          // without adaptive stopping
    double grow_seconds;    // growing and meshing
    double build_seconds;   // the ray tracer's structures
    double trace_seconds;   // all paths
    double preview_seconds; // previews as `ramify render` writes them
    double write_seconds;   // denoising, developing and writing a .png and an .exr
} RamifyEstimate;

// Estimates by doing a part of the work: grows and builds the scene, traces some thousand of its
// paths and develops a small picture. memory: bytes that are allowed, as for ramify_check_memory;
// 0 = no limit. isa: as for ramify_renderer_new. run may be NULL.
RAMIFY_API bool ramify_estimate(const RamifyScene *scene, const char *isa, int64_t memory,
                                const RamifyRun *run, RamifyEstimate *estimate, RamifyError *error);

// RAMIFY_BAD_INPUT if rendering the scene takes more than `memory` bytes, with the place of the key
// that takes most and the value that would do. built: 0 = judges by counts in the scene, before any
// work, and refuses only what certainly needs more; 1 = judges by what this process holds, once it
// has a renderer of the scene, and by the picture to come.
RAMIFY_API bool ramify_check_memory(const RamifyScene *scene, int64_t memory, int32_t built,
                                    RamifyError *error);

typedef struct RamifyRenderInfo {
    int64_t paths, rays;
    int64_t bytes;   // held by the renderer
    double seconds;  // of tracing
    int32_t samples; // per pixel, the least over all pixels; 0 = some have none
} RamifyRenderInfo;

// Called after every pass over the picture (1, 4, 16, 32, 64, ... samples) with the film so far.
typedef void (*RamifyPass)(void *user, const RamifyFilm *film, int samples);

// A first look: one path for each 4 x 4 pixels, whose result all of them get, in a sixteenth of the
// time of one sample per pixel. It counts as no sample: a rendering starts anew. run may be NULL.
RAMIFY_API bool ramify_renderer_look(RamifyRenderer *renderer, RamifyFilm *film,
                                     const RamifyRun *run, RamifyError *error);

// Renders into a film of the scene's size, replacing its contents except for pixels outside the
// crop. pass may be NULL and is called with user. When the time limit is reached, it leaves a
// complete picture of fewer samples and returns true; see info->samples. If cancelled, it does so
// immediately: 0 samples means that some pixels were not reached and are black and transparent; if
// no pixel was reached, it fails with RAMIFY_CANCELLED. info and run may be NULL.
RAMIFY_API bool ramify_renderer_render(RamifyRenderer *renderer, RamifyFilm *film, RamifyPass pass,
                                       void *user, const RamifyRun *run, RamifyRenderInfo *info,
                                       RamifyError *error);

// Goes on with the samples that the film holds (ramify_film_read, or a rendering that was cut
// short): the film becomes what ramify_renderer_render would have made of it, to the bit. pass is
// also called after every `every` seconds within a pass (0 = not), with the least samples of a
// pixel, to save the film; no thread then writes to it.
RAMIFY_API bool ramify_renderer_resume(RamifyRenderer *renderer, RamifyFilm *film, RamifyPass pass,
                                       double every, void *user, const RamifyRun *run,
                                       RamifyRenderInfo *info, RamifyError *error);

// One ray of a path, for debugging a pixel. Vectors are x, y, z in m; colours are linear.
typedef struct RamifyPathStep {
    const char *end; // what ends the ray: "surface", "lamp", "medium" (it scattered), "outside"
    const char *material;          // name, of a surface; else NULL; borrowed from the world
    int32_t object;                // of a surface; else -1
    float origin[3], position[3];  // where it begins and ends; outside: position = origin
    float direction[3], normal[3]; // unit; normal only of a surface
    float throughput[3];           // of the path before the ray
    float light[3]; // added to the path's estimate at its end, what shadow rays bring included
} RamifyPathStep;

// Traces sample number `sample` of pixel (x, y), both counted from 0, of the world's picture again
// and fills the first `most` rays of its path; returns their number, -1 on failure. color: what the
// path adds to the picture, after clamping. RAMIFY_BAD_INPUT when there is no such pixel or sample.
RAMIFY_API int ramify_renderer_replay(RamifyRenderer *renderer, const RamifyWorld *world, int x,
                                      int y, int sample, RamifyPathStep *step, int most,
                                      float color[3], RamifyError *error);

// ---- golden images ----

// Limits within which two pictures are alike; negative = no limit.
typedef struct RamifyLimits {
    double max_rmse;    // root mean square over all values
    double threshold;   // a pixel fails if a channel differs by more; negative = 0.012
    double max_failing; // largest share of failing pixels, 0..1
} RamifyLimits;

typedef struct RamifyDifference {
    int32_t alike;                     // 1 = within the limits
    int32_t width, height;             // pixels, of the first picture, or ours
    int32_t other_width, other_height; // if different, the numbers below are not computed
    double rmse, mean, maximum;        // over all values: display values 0..1, or radiance
    double failing;                    // share of pixels over the threshold, 0..1
    double psnr;                       // dB; INFINITY when equal
    double perceptual;                 // FLIP (Andersson 2020), mean over pixels, 0..1
    int32_t worst_x, worst_y;          // pixel of the maximum, from the top left
    int32_t statistical;               // 1 = compared statistically; then also:
    double p;                          // least alpha at which any block would be rejected
    double z;                          // of the most significant block
    int64_t tests, rejected;           // blocks times channels; how many differ
    char message[256];                 // why they are not alike; "" if they are
} RamifyDifference;

// Compares two picture files of any format (PNG, JPEG, EXR, HDR, ...): their colour, over black,
// and alpha. Different sizes are a difference. limits: NULL = every value must be equal. report:
// HTML page to write, or NULL. RAMIFY_BAD_INPUT if a file cannot be read, or if one holds radiance
// and the other display values.
RAMIFY_API bool ramify_compare(const char *ours, const char *other, const RamifyLimits *limits,
                               const char *report, RamifyDifference *difference,
                               RamifyError *error);

// Values of RamifyGoldenScene.status.
enum {
    RAMIFY_GOLDEN_ALIKE = 0,
    RAMIFY_GOLDEN_DIFFERENT = 1,
    RAMIFY_GOLDEN_MISSING = 2, // no stored image
    RAMIFY_GOLDEN_FAILED = 3,  // the scene or its stored image is invalid, or rendering failed
    RAMIFY_GOLDEN_STORED = 4,  // by an update
    RAMIFY_GOLDEN_ORPHAN = 5   // a stored image without a scene
};

// "alike", "different", ...; static text.
RAMIFY_API const char *ramify_golden_status_name(int status);

// Values of RamifyGoldenOptions.mode.
enum {
    RAMIFY_GOLDEN_AS_SCENE = 0, // the scene's own
    RAMIFY_GOLDEN_TOLERANCE = 1,
    RAMIFY_GOLDEN_EXACT = 2,
    RAMIFY_GOLDEN_STATISTICAL = 3
};

typedef struct RamifyGoldenScene {
    const char *name;    // the scene's file name without its extension; an orphan's with it
    const char *message; // what is wrong; "" = nothing
    int32_t status;
    const RamifyDifference *difference; // NULL = nothing was compared
    const RamifyLimits *limits;         // limits applied; negative = no limit
    double alpha;                       // probability of a false alarm, if statistical
    double seconds;
} RamifyGoldenScene;

typedef struct RamifyGoldenOptions {
    int32_t update;             // 1 = store different and missing images
    int32_t mode;               // for all scenes
    uint64_t series;            // statistical: other values give other seeds for our renderings
    const char *filter;         // pattern of scene names to take, with * and ?; NULL = all
    const char *isa;            // NULL = "sse4.2"; "native" = this machine's best
    const RamifyLimits *limits; // for all scenes, where not negative; NULL = the scenes' own
    const char *report;         // HTML page to write; NULL = none
    const char *junit;          // JUnit XML to write; NULL = none
    // Called after each scene; its arguments are valid until it returns. NULL = none.
    void (*each)(void *user, const RamifyGoldenScene *scene);
    void *user;
    int64_t memory; // bytes; scenes that certainly need more fail; 0 = no limit
} RamifyGoldenOptions;

typedef struct RamifyGoldenCounts {
    int32_t alike, different, missing, failed, stored, orphans;
} RamifyGoldenCounts;

// Renders every scene of the folder, pinned (instruction set, seed, samples), and compares it with
// its stored image: NAME.yaml with NAME.png, or NAME.exr if statistical. A failing scene is part of
// the result. options: NULL = compare with the scenes' own limits. run may be NULL.
// RAMIFY_BAD_INPUT if the folder cannot be read or has no scenes.
RAMIFY_API bool ramify_golden(const char *folder, const RamifyGoldenOptions *options,
                              const RamifyRun *run, RamifyGoldenCounts *counts, RamifyError *error);

// ---- films ----

enum { RAMIFY_MOST_KEYS = 16 };

// Values at equal steps of time; count 0 = none. If the last equals the first, frame i of N shows
// the time i/N, so that the animation loops without a jump; else i/(N-1), so that it ends on the
// last value.
typedef struct RamifyKeys {
    int32_t count; // at most RAMIFY_MOST_KEYS
    double value[RAMIFY_MOST_KEYS];
} RamifyKeys;

// Values of RamifyTurntable.ease.
enum { RAMIFY_EASE_USUAL = 0, RAMIFY_EASE_LINEAR = 1, RAMIFY_EASE_SMOOTH = 2 };

// The content of an animation; all zero: the camera orbits its target once, or, if the scene has an
// `animation:`, that alone is played.
typedef struct RamifyTurntable {
    int32_t frames;       // 0 = that of the scene's animation, else 72
    double fps;           // frames per second; 0 = that of the scene's animation, else 24
    int32_t start, count; // render frames start .. start + count - 1 only; count 0 = to the last
    double turns;         // full circles, negative in the other direction; 0 = the default
    int32_t still;        // 1 = no rotation
    int32_t spin;         // 1 = rotate the objects instead of camera, sky and lamps
    RamifyKeys elevation; // degrees of the camera above its target, -89 .. 89
    RamifyKeys dolly;     // factor on the camera's distance from its target
    RamifyKeys grow;      // share of the growth that is shown, 0..1
    RamifyKeys sun;       // solar time, hours, at 48 degrees north in mid-May; south is +Z
    int32_t ease;         // default: smooth for elevation and dolly, linear for the rest
    int32_t vary_noise;   // different noise pattern per frame: 1 yes, -1 no, 0 = the scene decides
    const char *isa;      // as for ramify_renderer_new
    // Seconds between savings of a frame that takes longer: f-07.begun.exr, with which the next
    // call goes on. 0 = 60; negative = never.
    double checkpoint;
} RamifyTurntable;

typedef struct RamifyTurntableInfo {
    int32_t frames;            // total
    int32_t rendered, skipped; // in this call; skipped: frames that existed
    int32_t geometries;        // number of times something was grown or skinned
    int32_t structures;        // number of times acceleration structures were built from scratch
    int64_t paths;
    double prepare_seconds, grow_seconds, mesh_seconds, build_seconds, trace_seconds;
    double finish_seconds; // waiting for pictures to be developed and written
    double video_seconds;
} RamifyTurntableInfo;

// The scene at a time of the animation, 0 .. 1, to be freed by ramify_scene_free. turntable NULL =
// all zero. RAMIFY_BAD_INPUT names the line of an invalid track.
RAMIFY_API RamifyScene *ramify_scene_at(const RamifyScene *scene, const RamifyTurntable *turntable,
                                        double time, RamifyError *error);

// The same at frame number frame, 0 .. frames - 1.
RAMIFY_API RamifyScene *ramify_scene_at_frame(const RamifyScene *scene,
                                              const RamifyTurntable *turntable, int frame,
                                              RamifyError *error);

// Renders an animation to file: "oak-%04d.png" (.png, .jpg or .exr, with the frame's number for
// %04d), or "oak.mp4" by ffmpeg (H.264, yuv420p, BT.709). Static parts are grown, skinned and built
// once. Frames that exist, complete and made with the same settings, are skipped, so an interrupted
// call can be resumed; those of a video are kept in oak.mp4.frames. turntable NULL = all zero; info
// and run may be NULL. info is filled on failure, too.
RAMIFY_API bool ramify_turntable(const RamifyScene *scene, const RamifyTurntable *turntable,
                                 const char *file, const RamifyRun *run, RamifyTurntableInfo *info,
                                 RamifyError *error);

// Checks in advance that ramify_turntable can write the file: RAMIFY_BAD_INPUT or RAMIFY_IO if not.
RAMIFY_API bool ramify_turntable_check(const char *file, RamifyError *error);

#ifdef __cplusplus
}
#endif

#endif
