// Scenes as other programs' files. A format is one file and one line of the registry in formats.h.
#ifndef RAMIFY_EXPORT_EXPORT_H
#define RAMIFY_EXPORT_EXPORT_H

#include "base/run.h"
#include "land/height_field.h"
#include "outtree/flow.h"
#include "outtree/out_tree.h"
#include "shape/grid_file.h"
#include "shape/points.h"

typedef struct World World;

// How formats that know instances write them.
typedef enum ExportInstances {
    EXPORT_INSTANCES_AUTO,  // the best way of the format: docs/formats.md
    EXPORT_INSTANCES_NODES, // nodes that share a mesh
    EXPORT_INSTANCES_GPU,   // glTF: EXT_mesh_gpu_instancing
    EXPORT_INSTANCES_FLAT   // a copy of the mesh each
} ExportInstances;

// The meaning of vertex colours.
typedef enum ExportColors {
    EXPORT_COLORS_ALL,     // patterns first, growth second where a format has two sets
    EXPORT_COLORS_PATTERN, // colours of procedural patterns
    EXPORT_COLORS_GROWTH,  // red: birth, 0..1; green: radius over the object's largest
    EXPORT_COLORS_NONE
} ExportColors;

// {0} holds the defaults.
typedef struct ExportOptions {
    const char *const *object; // names of the objects to write; NULL = all
    int object_count;
    ExportInstances instances;
    ExportColors colors;
    int tube_sides; // of curves written as tubes, 3 .. CURVE_TUBE_SIDES_MOST; 0 = CURVE_TUBE_SIDES
} ExportOptions;

// The scene to export. All borrowed; what the format does not need is NULL.
typedef struct ExportSource {
    const char *title;              // of the whole: the scene file's name
    ExportOptions options;          // the parts below hold no other objects than options.object
    const World *world;             // EXPORT_WORLD
    int object_count;               // of the scene: Part.object is an index
    const char *const *object_name; // object_count entries
    const OutTree *const *tree;     // EXPORT_TREES; NULL where nothing grew
    const FlowParams *flow;         // EXPORT_TREES: what flows through each; NULL = the default
    const HeightField *const *land; // EXPORT_LAND; NULL where an object is no land
    const GridFile *grids;          // EXPORT_GRIDS: envelopes and guide fields, named
    const PointSet *const *points;  // EXPORT_POINTS: attractors; NULL where none are kept
} ExportSource;

enum { EXPORT_WORLD = 1, EXPORT_TREES = 2, EXPORT_LAND = 4, EXPORT_GRIDS = 8, EXPORT_POINTS = 16 };

typedef struct ExportFormat {
    const char *ending; // ".glb"
    const char *doc;    // for people: what it is
    int extra;          // bytes by which the longest name of a file beside it exceeds its own
    unsigned needs;     // of the source
    // Writes the file, and no others than docs/formats.md names. On failure, older files stay.
    bool (*write)(const ExportSource *source, const char *file, const Run *run, Error *e);
} ExportFormat;

// The format by the ending of the file's name; NULL if there is none.
const ExportFormat *export_format(const char *file);

// All formats, for help and messages.
int export_format_count(void);
const ExportFormat *export_format_at(int index);

#endif
