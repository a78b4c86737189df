// All mappings of a scene file in the order in which a reader meets them, each with the places
// where it may stand.
#ifndef RAMIFY_SCENE_SCHEMA_OUTLINE_H
#define RAMIFY_SCENE_SCHEMA_OUTLINE_H

#include "scene/schema_text.h"

#define OUTLINE_MOST_SECTIONS 96
#define OUTLINE_MOST_PLACES 64

typedef struct OutlinePlace {
    const char *path;  // "objects.NAME.tree.trunk"; "" = the scene itself
    const char *title; // the same for readers: "tree trunk"
    const char *key;   // in the mapping that holds it
    int parent;        // section of that mapping; -1 for the scene
    const char *base;  // struct with the defaults there; NULL = none
} OutlinePlace;

typedef struct OutlineSection {
    const Table *table;
    const char *title; // of its only place, or its key where it has several
    int depth;         // 0 = the scene's own mappings and the kinds of objects, 1 = within those
    OutlinePlace places[OUTLINE_MOST_PLACES];
    int place_count;
} OutlineSection;

typedef struct Outline {
    OutlineSection sections[OUTLINE_MOST_SECTIONS]; // sections[0] is the scene
    int count;
} Outline;

// In the arena of s; NULL and s->failed when it does not fit.
Outline *outline_new(SchemaText *s);

#endif
