// The materials of a world, prepared for shading. Private to render/material.
#ifndef RAMIFY_RENDER_MATERIAL_MATERIAL_SET_H
#define RAMIFY_RENDER_MATERIAL_MATERIAL_SET_H

#include "render/material/bsdf.h"
#include "render/material/bsdf_ggx.h"
#include "render/material/texture.h"
#include "render/material/thin_film.h"

// Tables of a material whose roughness a picture changes.
enum { ROUGH_TABLES = 16 };

// A narrower lobe is a mirror, or this wide where it is mixed with other lobes.
#define LEAST_ALPHA 1e-3f

typedef struct MaterialEntry {
    Material material;
    const struct MaterialOps *ops;
    bool plain;                 // of one colour, and its kind prepares nothing
    bool lambert;               // reflects by Lambert's law alone
    float alpha;                // GGX; 0 = mirror
    GgxTable *table;            // owned; NULL if the kind needs none or no part has the material
    const ThinFilmTable *films; // borrowed from the set; NULL likewise
    GgxTable *rough_tables;     // owned, ROUGH_TABLES of them from roughness 0 to 1; NULL = `table`
                                // is for all of the surface
    bool mapped;                // one of the pictures but opacity is given
    struct WindRipples *ripples; // owned; NULL without wind on water
    int *layer;                  // owned: the numbers of its layers' materials; NULL = it has none
    // Borrowed from the cache; NULL = none.
    Texture *color, *opacity, *normal, *roughness, *transmittance, *displacement;
} MaterialEntry;

struct MaterialSet {
    int count;
    MaterialEntry *entry;
    TextureCache *textures;      // NULL if no material has one
    const struct MaskSet *masks; // borrowed; NULL = no layer lies anywhere
    ThinFilmTable *films;        // NULL if no material is a thin film
};

// Allocates the entry's table and sets its alpha, which is not 0: LEAST_ALPHA where the lobe is
// narrower.
bool material_entry_add_table(MaterialEntry *entry, Error *e);

// Is the lobe so narrow that a material of one lobe becomes a mirror?
bool material_entry_is_mirror(const MaterialEntry *entry);

#endif
