// Textures from picture files, looked up by uv. A file is read whole in a child process with
// limits. Lookups are filtered by the footprint (mip_map.h) and may run in many threads.
#ifndef RAMIFY_RENDER_MATERIAL_TEXTURE_H
#define RAMIFY_RENDER_MATERIAL_TEXTURE_H

#include "base/run.h"
#include "base/vec.h"

typedef struct TextureCache TextureCache;
typedef struct Texture Texture;

TextureCache *texture_cache_new(Error *e);
void texture_cache_free(TextureCache *cache); // NULL is fine; frees its textures

// Owned by the cache, which reads a file once. ERROR_INPUT naming the file when it cannot be read
// as an image.
Texture *texture_open(TextureCache *cache, const char *file, const Run *run, Error *e);

// Linear colour at uv (v up, repeating), averaged over a patch of du by dv. 8-bit files are sRGB.
// May be called from many threads.
Vec3 texture_color(const Texture *texture, Vec2 uv, float du, float dv);

// The same without a conversion from sRGB: numbers that are no colours, such as normals.
Vec3 texture_data(const Texture *texture, Vec2 uv, float du, float dv);

// Alpha if the file has it, else its first channel, unfiltered; 0..1.
float texture_opacity(const Texture *texture, Vec2 uv);

#endif
