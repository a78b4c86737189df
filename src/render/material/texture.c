#include "render/material/texture.h"

#include "base/memory.h"
#include "image/image.h"
#include "render/material/mip_map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct Texture {
    char *file;
    Texels *texels;
    MipMap *map;
    Texture *next; // in the cache
};

struct TextureCache {
    Texture *first;
};

static void texture_free(Texture *texture)
{
    mip_map_free(texture->map);
    texels_free(texture->texels);
    free(texture->file);
    free(texture);
}

TextureCache *texture_cache_new(Error *e)
{
    return memory_alloc_zero(1, sizeof(TextureCache), e);
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
    free(cache);
}

static bool read_texture(Texture *texture, const char *file, const Run *run, Error *e)
{
    texture->file = memory_copy_string(file, e);
    texture->texels = texture->file ? image_read_texels(file, run, e) : NULL;
    if (!texture->texels) {
        return false;
    }
    texture->map = mip_map_new(texture->texels, e);
    if (!texture->map) {
        error_prefix(e, "texture '%s' cannot be read: ", file);
    }
    return texture->map;
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
    if (!read_texture(texture, file, run, e)) {
        texture_free(texture);
        return NULL;
    }
    texture->next = cache->first;
    cache->first = texture;
    return texture;
}

// Four channels at uv; what the file lacks is filled with 1 for alpha, else with 0.
static void lookup(const Texture *texture, Vec2 uv, float du, float dv, float value[4])
{
    int channels = texture->texels->channels;
    value[0] = value[1] = value[2] = 0.0f;
    value[3] = 1.0f;
    mip_map_lookup(texture->map, uv, du, dv, channels < 4 ? channels : 4, value);
    if (channels == 2) {
        value[3] = value[1];
    }
    if (channels < 3) {
        value[1] = value[2] = value[0];
    }
}

static float linear_from_srgb(float x)
{
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

Vec3 texture_color(const Texture *texture, Vec2 uv, float du, float dv)
{
    float value[4];
    lookup(texture, uv, du, dv, value);
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
    lookup(texture, uv, du, dv, value);
    return vec3(value[0], value[1], value[2]);
}

float texture_opacity(const Texture *texture, Vec2 uv)
{
    float value[4];
    lookup(texture, uv, 0.0f, 0.0f, value);
    int channels = texture->texels->channels;
    bool has_alpha = channels == 2 || channels >= 4;
    return clampf(has_alpha ? value[3] : value[0], 0.0f, 1.0f);
}
