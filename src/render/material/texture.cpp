// The only file that knows OpenImageIO's texture system. It filters and caches; files are read in a
// child process (image/image.h), whose pixels it takes for a file of its own.
#include <math.h>

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

extern "C" {
#include "image/image.h"
#include "render/material/texture.h"
}

struct Texture {
    std::string file;
    OIIO::TextureSystem *system = nullptr;
    OIIO::TextureSystem::TextureHandle *handle = nullptr;
    OIIO::ustring name; // in the system
    Texels *texels = nullptr;
    int channels = 0;
    bool srgb = false;

    ~Texture()
    {
        if (!name.empty()) {
            system->imagecache()->invalidate(name, true); // closed before its pixels go
        }
        texels_free(texels);
    }
};

struct TextureCache {
    OIIO::TextureSystem *system = nullptr;
    std::vector<std::unique_ptr<Texture>> textures;

    ~TextureCache()
    {
        textures.clear();
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

const char TEXELS[] = "ramify:texels"; // the attribute that leads to them

// A "file" of texels in memory.
class TexelInput final : public OIIO::ImageInput
{
  public:
    const char *format_name() const override
    {
        return "texels";
    }

    bool open(const std::string &, OIIO::ImageSpec &) override
    {
        return false;
    }

    bool open(const std::string &, OIIO::ImageSpec &spec, const OIIO::ImageSpec &config) override
    {
        void *data = nullptr;
        if (!config.getattribute(TEXELS, OIIO::TypeDesc::PTR, &data) || !data) {
            return false;
        }
        texels = static_cast<const Texels *>(data);
        m_spec = OIIO::ImageSpec(texels->width, texels->height, texels->channels, format());
        m_spec.x = texels->window[0];
        m_spec.y = texels->window[1];
        m_spec.full_x = texels->window[2];
        m_spec.full_y = texels->window[3];
        m_spec.full_width = texels->window[4];
        m_spec.full_height = texels->window[5];
        spec = m_spec;
        return true;
    }

    bool close() override
    {
        return true;
    }

    bool read_native_scanline(int subimage, int miplevel, int y, int, void *data) override
    {
        int row = y - m_spec.y;
        if (subimage != 0 || miplevel != 0 || row < 0 || row >= texels->height) {
            return false;
        }
        size_t bytes =
            size_t(texels->width) * size_t(texels->channels) * size_t(texel_bytes(texels->type));
        std::memcpy(data, static_cast<const char *>(texels->data) + size_t(row) * bytes, bytes);
        return true;
    }

  private:
    OIIO::TypeDesc format() const
    {
        switch (texels->type) {
        case TEXEL_BYTE:
            return OIIO::TypeDesc::UINT8;
        case TEXEL_SHORT:
            return OIIO::TypeDesc::UINT16;
        case TEXEL_HALF:
            return OIIO::TypeDesc::HALF;
        default:
            return OIIO::TypeDesc::FLOAT;
        }
    }

    const Texels *texels = nullptr;
};

OIIO::ImageInput *new_texel_input()
{
    return new TexelInput;
}

// Makes the texels known to the system. Their name there is their place in memory, which no two
// have at a time.
bool hand_over(Texture *texture)
{
    char name[64];
    std::snprintf(name, sizeof name, "ramify texels %p", static_cast<void *>(texture->texels));
    OIIO::ImageSpec config;
    const void *data = texture->texels;
    config.attribute(TEXELS, OIIO::TypeDesc::PTR, &data);
    texture->name = OIIO::ustring(name);
    bool added =
        texture->system->imagecache()->add_file(texture->name, new_texel_input, &config, true);
    texture->handle = added ? texture->system->get_texture_handle(texture->name) : nullptr;
    return texture->handle && texture->system->good(texture->handle);
}

Texture *open_texture(TextureCache *cache, const char *file, const Run *run, Error *e)
{
    for (auto &known : cache->textures) {
        if (known->file == file) {
            return known.get();
        }
    }
    auto texture = std::make_unique<Texture>();
    texture->file = file;
    texture->system = cache->system;
    texture->texels = image_read_texels(file, run, e);
    if (!texture->texels) {
        return nullptr;
    }
    if (!hand_over(texture.get())) {
        error_set(e, ERROR_INTERNAL, "texture '%s' cannot be read: %s", file,
                  cache->system->geterror().c_str());
        return nullptr;
    }
    texture->channels = texture->texels->channels;
    texture->srgb = texture->texels->type == TEXEL_BYTE;
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

extern "C" Texture *texture_open(TextureCache *cache, const char *file, const Run *run, Error *e)
{
    try {
        return open_texture(cache, file, run, e);
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
