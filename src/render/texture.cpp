// The only file that knows OpenImageIO's texture system.
#include <math.h>

#include <OpenImageIO/texture.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

extern "C" {
#include "render/texture.h"
}

struct Texture {
    OIIO::TextureSystem *system = nullptr;
    OIIO::TextureSystem::TextureHandle *handle = nullptr;
    int channels = 0;
    bool srgb = false;
};

struct TextureCache {
    OIIO::TextureSystem *system = nullptr;
    std::vector<std::unique_ptr<Texture>> textures;

    ~TextureCache()
    {
        if (system) {
            OIIO::TextureSystem::destroy(system);
        }
    }
};

namespace
{

float linear_from_srgb(float x)
{
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

Texture *open_texture(TextureCache *cache, const char *file, Error *e)
{
    auto texture = std::make_unique<Texture>();
    texture->system = cache->system;
    texture->handle = cache->system->get_texture_handle(OIIO::ustring(file));
    OIIO::ImageSpec spec;
    if (!texture->handle || !cache->system->good(texture->handle) ||
        !cache->system->get_imagespec(texture->handle, nullptr, 0, spec)) {
        std::string reason = cache->system->geterror();
        error_set(e, ERROR_INPUT, "texture '%s' cannot be read: %s", file,
                  reason.empty() ? "no such image" : reason.c_str());
        return nullptr;
    }
    texture->channels = spec.nchannels;
    texture->srgb = spec.format == OIIO::TypeDesc::UINT8;
    cache->textures.push_back(std::move(texture));
    return cache->textures.back().get();
}

// Four channels at uv; what the file lacks is filled with 1 for alpha, else with 0.
void lookup(const Texture *texture, Vec2 uv, float du, float dv, float value[4])
{
    OIIO::TextureOpt options;
    options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
    value[0] = value[1] = value[2] = 0.0f;
    value[3] = 1.0f;
    int channels = std::min(texture->channels, 4);
    texture->system->texture(texture->handle, nullptr, options, uv.x, 1.0f - uv.y, du, 0.0f, 0.0f,
                             dv, channels, value);
    if (channels == 2) {
        value[3] = value[1];
    }
    if (channels < 3) {
        value[1] = value[2] = value[0];
    }
}

} // namespace

extern "C" TextureCache *texture_cache_new(Error *e)
{
    try {
        auto cache = std::make_unique<TextureCache>();
        // the process's own: destroying a private one frees memory with a size it was not made with
        cache->system = OIIO::TextureSystem::create(true);
        cache->system->invalidate_all(false); // files that changed since the last rendering
        cache->system->attribute("automip", 1);
        cache->system->attribute("autotile", 64);
        cache->system->attribute("max_memory_MB", 1024.0f);
        return cache.release();
    } catch (const std::bad_alloc &) {
        error_set(e, ERROR_MEMORY, "out of memory for the texture cache");
    } catch (const std::exception &failure) {
        error_set(e, ERROR_INTERNAL, "no texture cache: %s", failure.what());
    } catch (...) {
        error_set(e, ERROR_INTERNAL, "no texture cache: unknown failure");
    }
    return nullptr;
}

extern "C" void texture_cache_free(TextureCache *cache)
{
    delete cache;
}

extern "C" Texture *texture_open(TextureCache *cache, const char *file, Error *e)
{
    try {
        return open_texture(cache, file, e);
    } catch (const std::bad_alloc &) {
        error_set(e, ERROR_MEMORY, "out of memory while texture '%s' is read", file);
    } catch (const std::exception &failure) {
        error_set(e, ERROR_INTERNAL, "texture '%s' cannot be read: %s", file, failure.what());
    } catch (...) {
        error_set(e, ERROR_INTERNAL, "texture '%s' cannot be read: unknown failure", file);
    }
    return nullptr;
}

extern "C" Vec3 texture_color(const Texture *texture, Vec2 uv, float du, float dv)
{
    float value[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    try {
        lookup(texture, uv, du, dv, value);
    } catch (...) { // a tile that fails half-way through a rendering shows as white
        return vec3(1.0f, 1.0f, 1.0f);
    }
    if (texture->srgb) {
        for (int i = 0; i < 3; i++) {
            value[i] = linear_from_srgb(value[i]);
        }
    }
    return vec3(value[0], value[1], value[2]);
}

extern "C" float texture_opacity(const Texture *texture, Vec2 uv)
{
    float value[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    try {
        lookup(texture, uv, 0.0f, 0.0f, value);
    } catch (...) {
        return 1.0f;
    }
    bool has_alpha = texture->channels == 2 || texture->channels >= 4;
    return clampf(has_alpha ? value[3] : value[0], 0.0f, 1.0f);
}
