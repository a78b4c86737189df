// The materials of a world made ready for shading. Private to the BSDF's files.
#ifndef RAMIFY_RENDER_MATERIAL_MATERIAL_SET_H
#define RAMIFY_RENDER_MATERIAL_MATERIAL_SET_H

#include "render/material/bsdf.h"
#include "render/material/bsdf_ggx.h"
#include "render/material/texture.h"
#include "render/material/thin_film.h"

typedef struct MaterialEntry {
    Material material;
    bool plain;       // diffuse of one colour
    float alpha;      // GGX; 0 = mirror
    GgxTable *table;  // owned; NULL where the kind needs none, or nothing is made of it
    Texture *color;   // borrowed from the cache; NULL = none
    Texture *opacity; // likewise
} MaterialEntry;

struct MaterialSet {
    int count;
    MaterialEntry *entry;
    TextureCache *textures; // NULL while no material has any
    ThinFilmTable *films;   // NULL while no material is one
};

#endif
