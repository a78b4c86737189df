// The only file that knows OpenImageIO's texture system. It filters and caches; files are read in a
// child process (texture.c), whose pixels it takes for a file of its own.
#include <math.h>

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>

extern "C" {
#include "render/material/texture_filter.h"
}

struct TextureSystem {
    OIIO::TextureSystem *oiio = nullptr;

    ~TextureSystem()
    {
        OIIO::TextureSystem::destroy(oiio);
    }
};

struct FilteredTexture {
    OIIO::TextureSystem *system = nullptr;
    OIIO::TextureSystem::TextureHandle *handle = nullptr;
    OIIO::ustring name; // in the system

    ~FilteredTexture()
    {
        if (!name.empty()) {
            system->imagecache()->invalidate(name, true); // closes it
        }
    }
};

namespace
{

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
bool hand_over(FilteredTexture &texture, const Texels *texels)
{
    char name[64];
    std::snprintf(name, sizeof name, "ramify texels %p", static_cast<const void *>(texels));
    OIIO::ImageSpec config;
    const void *data = texels;
    config.attribute(TEXELS, OIIO::TypeDesc::PTR, &data);
    texture.name = OIIO::ustring(name);
    bool added =
        texture.system->imagecache()->add_file(texture.name, new_texel_input, &config, true);
    texture.handle = added ? texture.system->get_texture_handle(texture.name) : nullptr;
    return texture.handle && texture.system->good(texture.handle);
}

TextureSystem *system_new(Error *e)
{
    try {
        auto system = std::make_unique<TextureSystem>();
        // the process's own: destroying a private one frees memory with a size it was not made with
        system->oiio = OIIO::TextureSystem::create(true);
        system->oiio->attribute("automip", 1);
        system->oiio->attribute("autotile", 64);
        system->oiio->attribute("max_memory_MB", 1024.0f);
        return system.release();
    } catch (const std::bad_alloc &) {
        error_set(e, ERROR_MEMORY, "out of memory for the texture cache");
    } catch (const std::exception &failure) {
        error_set(e, ERROR_INTERNAL, "no texture cache: %s", failure.what());
    } catch (...) {
        error_set(e, ERROR_INTERNAL, "no texture cache: unknown failure");
    }
    return nullptr;
}

void system_free(TextureSystem *system)
{
    delete system;
}

FilteredTexture *add(TextureSystem *system, const Texels *texels, Error *e)
{
    try {
        auto texture = std::make_unique<FilteredTexture>();
        texture->system = system->oiio;
        if (hand_over(*texture, texels)) {
            return texture.release();
        }
        error_set(e, ERROR_INTERNAL, "%s", system->oiio->geterror().c_str());
    } catch (const std::bad_alloc &) {
        error_set(e, ERROR_MEMORY, "out of memory");
    } catch (const std::exception &failure) {
        error_set(e, ERROR_INTERNAL, "%s", failure.what());
    } catch (...) {
        error_set(e, ERROR_INTERNAL, "unknown failure");
    }
    return nullptr;
}

void remove_texture(FilteredTexture *texture)
{
    delete texture;
}

bool lookup(const FilteredTexture *texture, Vec2 uv, float du, float dv, int channels,
            float value[4])
{
    try {
        OIIO::TextureOpt options;
        options.swrap = options.twrap = OIIO::TextureOpt::WrapPeriodic;
        texture->system->texture(texture->handle, nullptr, options, uv.x, 1.0f - uv.y, du, 0.0f,
                                 0.0f, dv, channels, value);
        return true;
    } catch (...) {
        return false;
    }
}

} // namespace

extern "C" const TextureFilter texture_filter_oiio;
const TextureFilter texture_filter_oiio = {sizeof(TextureFilter), system_new, system_free, add,
                                           remove_texture,        lookup};
