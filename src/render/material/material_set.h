// The materials of a world made ready for shading. Private to the BSDF's files.
#ifndef RAMIFY_RENDER_MATERIAL_MATERIAL_SET_H
#define RAMIFY_RENDER_MATERIAL_MATERIAL_SET_H

#include "render/material/bsdf.h"
#include "render/material/bsdf_ggx.h"
#include "render/material/texture.h"
#include "render/material/thin_film.h"

typedef struct MaterialEntry {
    Material material;
    const struct MaterialOps *ops;
    bool plain;                 // of one colour, and its kind prepares nothing
    bool lambert;               // reflects by Lambert's law alone
    float alpha;                // GGX; 0 = mirror
    GgxTable *table;            // owned; NULL where the kind needs none, or nothing is made of it
    const ThinFilmTable *films; // borrowed from the set; likewise
    Texture *color;             // borrowed from the cache; NULL = none
    Texture *opacity;           // likewise
} MaterialEntry;

struct MaterialSet {
    int count;
    MaterialEntry *entry;
    TextureCache *textures; // NULL while no material has any
    ThinFilmTable *films;   // NULL while no material is one
};

// Allocates the entry's table and sets its alpha, which is not 0: LEAST_ALPHA where the lobe is
// narrower.
bool material_entry_add_table(MaterialEntry *entry, Error *e);

// So smooth that a material of one lobe is a mirror?
bool material_entry_is_mirror(const MaterialEntry *entry);

#endif
