// Scenes as other programs' files. One file a format, one line a format in export.c: nothing else
// knows how many there are.
#ifndef RAMIFY_EXPORT_EXPORT_H
#define RAMIFY_EXPORT_EXPORT_H

#include "base/run.h"
#include "land/height_field.h"
#include "outtree/out_tree.h"
#include "shape/grid_file.h"

typedef struct World World;

// How instances are written by formats that can keep them.
typedef enum ExportInstances {
    EXPORT_INSTANCES_AUTO,  // as the format does best: docs/formats.md
    EXPORT_INSTANCES_NODES, // each names the same mesh
    EXPORT_INSTANCES_GPU,   // glTF: EXT_mesh_gpu_instancing
    EXPORT_INSTANCES_FLAT   // each a copy of the mesh
} ExportInstances;

// What the colours of vertices show.
typedef enum ExportColors {
    EXPORT_COLORS_ALL,     // patterns first, growth second where a format has two sets
    EXPORT_COLORS_PATTERN, // what procedural patterns look like
    EXPORT_COLORS_GROWTH,  // red: birth, 0..1; green: radius over the object's largest
    EXPORT_COLORS_NONE
} ExportColors;

// {0} is what is best for most.
typedef struct ExportOptions {
    const char *const *object; // names of the only objects to write; NULL = all
    int object_count;
    ExportInstances instances;
    ExportColors colors;
    int tube_sides; // of curves written as tubes, 3 .. CURVE_TUBE_SIDES_MOST; 0 = CURVE_TUBE_SIDES
} ExportOptions;

// What is there to be exported. All borrowed; what the format does not need is NULL.
typedef struct ExportSource {
    const char *title;              // of the whole: the scene file's name
    ExportOptions options;          // objects: those left out are in no part below
    const World *world;             // EXPORT_WORLD
    int object_count;               // of the scene: Part.object is an index
    const char *const *object_name; // object_count entries
    const OutTree *const *tree;     // EXPORT_TREES; NULL where nothing grew
    const HeightField *const *land; // EXPORT_LAND; NULL where an object is no land
    const GridFile *grids;          // EXPORT_GRIDS: envelopes and guide fields, named
} ExportSource;

enum { EXPORT_WORLD = 1, EXPORT_TREES = 2, EXPORT_LAND = 4, EXPORT_GRIDS = 8 };

typedef struct ExportFormat {
    const char *ending; // ".glb"
    const char *doc;    // for people: what it is
    int extra;          // bytes by which the longest name of what is written beside it is longer
    unsigned needs;     // of the source
    // Writes the file, and nothing but it and what docs/formats.md names beside it. A failure
    // leaves what was there.
    bool (*write)(const ExportSource *source, const char *file, const Run *run, Error *e);
} ExportFormat;

// The format that the file's name ends in; NULL when there is none.
const ExportFormat *export_format(const char *file);

// All of them, for help and messages.
int export_format_count(void);
const ExportFormat *export_format_at(int index);

#endif
