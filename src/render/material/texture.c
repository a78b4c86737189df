#include "render/material/texture.h"

#include "base/memory.h"
#include "base/plugin.h"
#include "image/codec.h"
#include "render/material/texture_filter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct Texture {
    char *file;
    Texels *texels;
    const TextureFilter *filter;
    FilteredTexture *filtered;
    Texture *next; // in the cache
};

struct TextureCache {
    const TextureFilter *filter;
    TextureSystem *system;
    Texture *first;
};

static void texture_free(Texture *texture)
{
    if (texture->filtered) {
        texture->filter->remove(texture->filtered); // before its texels go
    }
    texels_free(texture->texels);
    free(texture->file);
    free(texture);
}

TextureCache *texture_cache_new(Error *e)
{
    const TextureFilter *filter = plugin_table(OIIO_PLUGIN, TEXTURE_FILTER, sizeof *filter, e);
    TextureCache *cache = filter ? memory_alloc_zero(1, sizeof *cache, e) : NULL;
    if (cache) {
        cache->filter = filter;
        cache->system = filter->system_new(e);
        if (!cache->system) {
            free(cache);
            return NULL;
        }
    }
    return cache;
}

void texture_cache_free(TextureCache *cache)
{
    if (!cache) {
        return;
    }
    while (cache->first) {
        Texture *texture = cache->first;
        cache->first = texture->next;
        texture_free(texture);
    }
    cache->filter->system_free(cache->system);
    free(cache);
}

static bool read_texture(Texture *texture, TextureCache *cache, const char *file, const Run *run,
                         Error *e)
{
    texture->filter = cache->filter;
    texture->file = memory_copy_string(file, e);
    texture->texels = texture->file ? image_read_texels(file, run, e) : NULL;
    if (!texture->texels) {
        return false;
    }
    texture->filtered = cache->filter->add(cache->system, texture->texels, e);
    if (!texture->filtered) {
        error_prefix(e, "texture '%s' cannot be read: ", file);
    }
    return texture->filtered;
}

Texture *texture_open(TextureCache *cache, const char *file, const Run *run, Error *e)
{
    for (Texture *known = cache->first; known; known = known->next) {
        if (strcmp(known->file, file) == 0) {
            return known;
        }
    }
    Texture *texture = memory_alloc_zero(1, sizeof *texture, e);
    if (!texture) {
        return NULL;
    }
    if (!read_texture(texture, cache, file, run, e)) {
        texture_free(texture);
        return NULL;
    }
    texture->next = cache->first;
    cache->first = texture;
    return texture;
}

// Four channels at uv; what the file lacks is filled with 1 for alpha, else with 0.
static bool lookup(const Texture *texture, Vec2 uv, float du, float dv, float value[4])
{
    int channels = texture->texels->channels;
    value[0] = value[1] = value[2] = 0.0f;
    value[3] = 1.0f;
    if (!texture->filter->lookup(texture->filtered, uv, du, dv, channels < 4 ? channels : 4,
                                 value)) {
        return false;
    }
    if (channels == 2) {
        value[3] = value[1];
    }
    if (channels < 3) {
        value[1] = value[2] = value[0];
    }
    return true;
}

static float linear_from_srgb(float x)
{
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

Vec3 texture_color(const Texture *texture, Vec2 uv, float du, float dv)
{
    float value[4];
    if (!lookup(texture, uv, du, dv, value)) { // a tile that fails during a rendering is white
        return vec3(1.0f, 1.0f, 1.0f);
    }
    if (texture->texels->type == TEXEL_BYTE) {
        for (int i = 0; i < 3; i++) {
            value[i] = linear_from_srgb(value[i]);
        }
    }
    return vec3(value[0], value[1], value[2]);
}

Vec3 texture_data(const Texture *texture, Vec2 uv, float du, float dv)
{
    float value[4];
    return lookup(texture, uv, du, dv, value) ? vec3(value[0], value[1], value[2])
                                              : vec3(0.5f, 0.5f, 1.0f); // an even surface
}

float texture_opacity(const Texture *texture, Vec2 uv)
{
    float value[4];
    if (!lookup(texture, uv, 0.0f, 0.0f, value)) {
        return 1.0f;
    }
    int channels = texture->texels->channels;
    bool has_alpha = channels == 2 || channels >= 4;
    return clampf(has_alpha ? value[3] : value[0], 0.0f, 1.0f);
}
