// All mappings of a scene file, in reading order, each with the places where it can
// appear.
#ifndef RAMIFY_SCENE_SCHEMA_OUTLINE_H
#define RAMIFY_SCENE_SCHEMA_OUTLINE_H

#include "scene/schema_text.h"

#define OUTLINE_MOST_SECTIONS 128
#define OUTLINE_MOST_PLACES 96

typedef struct OutlinePlace {
    const char *path;  // "objects.NAME.tree.trunk"; "" = the scene itself
    const char *title; // readable form: "tree trunk"
    const char *key;   // in the parent mapping
    int parent;        // section of that mapping; -1 for the scene
    const char *base;  // struct with the defaults at this place; NULL = none
} OutlinePlace;

typedef struct OutlineSection {
    const Table *table;
    const char *title; // title of its only place, or its key if it has several
    int depth;         // 0 = the scene's own mappings and the kinds of objects, 1 = within those
    OutlinePlace places[OUTLINE_MOST_PLACES];
    int place_count;
} OutlineSection;

typedef struct Outline {
    OutlineSection sections[OUTLINE_MOST_SECTIONS]; // sections[0] is the scene
    int count;
} Outline;

// Allocated in the arena of s; NULL and s->failed when a limit is exceeded.
Outline *outline_new(SchemaText *s);

#endif
