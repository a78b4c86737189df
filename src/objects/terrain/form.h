// What makes the land of one form. A new form is an entry of forms.c, its own file, and its keys.
#ifndef RAMIFY_OBJECTS_TERRAIN_FORM_H
#define RAMIFY_OBJECTS_TERRAIN_FORM_H

#include "objects/terrain/internal.h"

// What the square's copies beyond it are.
typedef enum Repeat {
    REPEAT_MIRRORED, // their borders meet
    REPEAT_SHORE,    // mirrored, too, but only along the shore and once inland
    REPEAT_PERIODIC, // itself, which repeats
    REPEAT_ALONG     // mirrored along x; along z itself, on its slope
} Repeat;

enum { FORM_MOST_SAMPLES = 256 };

typedef struct Form {
    const char *material; // of the land, unless the scene names beds or a material; NULL = mountain
    const char *water;    // of the water that `water` of its heights tells; NULL = there is none
    Repeat repeat;
    float relief;     // m by the metre of the size, if the scene gives none; 0 = by the slopes
    float wavelength; // of the noise's first octave, share of the size, if the scene gives none
    bool shows_beds;  // so does its material
    bool hollows;     // its hollows are the land's own; `drain` fills those that are no lakes
    bool plateau;     // it was a plateau of beds once
    // The tree, on the plane y = 0; NULL = none. *tree may be set on failure.
    bool (*grow)(OutTree **tree, const TerrainParams *params, const Recipe *recipe, Error *e);
    // Fills in the tree's heights and radii, and what depends on them. NULL = nothing to do.
    bool (*finish_tree)(Terrain *terrain, const Run *run, Error *e);
    // Land that processes wear, on a grid of its own, which the caller frees; fills in
    // terrain->ground if the form records it. NULL = the land is not worn so.
    Landscape *(*evolve)(Terrain *terrain, const Run *run, Error *e);
    // Cells a side of that grid. NULL = evolution.cells, at most the resolution.
    int (*cells)(const TerrainParams *params);
    // What else heights are looked up in. NULL = nothing.
    bool (*prepare)(Terrain *terrain, const Run *run, Error *e);
    // Makes room for what the field records beside heights and wetness. NULL = nothing.
    bool (*record)(HeightField *field, Error *e);
    // Fills sample i of the field, at a place.
    void (*sample)(const Terrain *terrain, HeightField *field, int64_t i, float x, float z);
    // Fills `count` <= FORM_MOST_SAMPLES samples of a row, from i on. NULL = one by one.
    void (*sample_part)(const Terrain *terrain, HeightField *field, int64_t i, const float *x,
                        float z, int count);
    // After erosion, before terraces, and after them. NULL = nothing to do.
    bool (*drain)(Terrain *terrain, HeightField *field, const Run *run, Error *e);
    bool (*finish)(Terrain *terrain, HeightField *field, const Run *run, Error *e);
    // Of water with levels of its own: how rough its flow is at a place, 0..1; of a delta's how
    // much mud it carries.
    float (*roughness)(const Terrain *terrain, float x, float z);
    // The streamline of its flow there, m: across a river that flows evenly. NULL = not known.
    float (*line)(const Terrain *terrain, float x, float z);
    // What lies around the square, instead of its copies. NULL = its copies.
    bool (*beyond)(const Terrain *terrain, const Placing *placing, Error *e);
    // Beside what all forms that evolve measure. NULL = nothing.
    bool (*measure)(const Terrain *terrain, MeasureList *list, Error *e);
} Form;

const Form *terrain_form(const TerrainParams *params);

#endif
