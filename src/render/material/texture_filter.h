// The part of the plug-in ramify-oiio.so that filters textures by OpenImageIO's texture system, as
// a table of functions. For texture.c alone.
#ifndef RAMIFY_RENDER_MATERIAL_TEXTURE_FILTER_H
#define RAMIFY_RENDER_MATERIAL_TEXTURE_FILTER_H

#include "base/vec.h"
#include "image/image.h"

#define TEXTURE_FILTER "texture_filter_oiio" // in OIIO_PLUGIN (image/codec.h); see plugin_table

typedef struct TextureSystem TextureSystem;
typedef struct FilteredTexture FilteredTexture;

typedef struct TextureFilter {
    size_t size; // of this struct
    TextureSystem *(*system_new)(Error *e);
    void (*system_free)(TextureSystem *system); // frees nothing that was added
    // Makes texels known to the system, which reads them until they are removed. ERROR_MEMORY,
    // ERROR_INTERNAL with the reason.
    FilteredTexture *(*add)(TextureSystem *system, const Texels *texels, Error *e);
    void (*remove)(FilteredTexture *texture);
    // The first channels (at most 4) at uv, averaged over a patch of du by dv. False when a tile
    // fails. Thread-safe.
    bool (*lookup)(const FilteredTexture *texture, Vec2 uv, float du, float dv, int channels,
                   float value[4]);
} TextureFilter;

#endif
