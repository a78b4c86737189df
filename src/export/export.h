// Scenes as other programs' files. One file a format, one line a format in export.c: nothing else
// knows how many there are.
#ifndef RAMIFY_EXPORT_EXPORT_H
#define RAMIFY_EXPORT_EXPORT_H

#include "base/run.h"
#include "mesh/height_field.h"
#include "render/world.h"
#include "tree/out_tree.h"

// What is there to be exported. All borrowed; what the format does not need is NULL.
typedef struct ExportSource {
    const char *title;              // of the whole: the scene file's name
    const World *world;             // EXPORT_WORLD
    int object_count;               // of the scene: Part.object is an index
    const char *const *object_name; // object_count entries
    const OutTree *const *tree;     // EXPORT_TREES; NULL where nothing grew
    const HeightField *const *land; // EXPORT_LAND; NULL where an object is no land
} ExportSource;

enum { EXPORT_WORLD = 1, EXPORT_TREES = 2, EXPORT_LAND = 4 };

typedef struct ExportFormat {
    const char *ending; // ".glb"
    const char *doc;    // for people: what it is
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
