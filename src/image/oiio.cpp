// The only file that knows OpenImageIO's image input and output. Pictures are encoded in memory
// and written by file_replace, so that every failure of the disk is seen.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

extern "C" {
#include "base/file_replace.h"
#include "base/memory.h"
#include "image/image.h"
#include "image/quantise.h"
}

namespace
{

using Bytes = std::vector<unsigned char>;

// Runs body; turns what it throws into an Error. what: "'x.png' cannot be written"
template <typename Body> bool guarded(const std::string &what, Error *e, Body body)
{
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "%s: out of memory", what.c_str());
    } catch (const std::exception &failure) {
        return error_set(e, ERROR_INTERNAL, "%s: %s", what.c_str(), failure.what());
    } catch (...) {
        return error_set(e, ERROR_INTERNAL, "%s: unknown failure", what.c_str());
    }
}

std::string extension_of(const char *file)
{
    std::string extension = OIIO::Filesystem::extension(file, false);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return extension;
}

// The pairs as attributes; formats without free attributes get them as one text.
void add_metadata(OIIO::ImageSpec &spec, const char *metadata, bool as_one_text)
{
    std::string text;
    for (const char *key = metadata; key && *key;) {
        const char *value = key + std::strlen(key) + 1;
        if (as_one_text) {
            text += std::string(key) + ": " + value + "\n";
        } else {
            spec.attribute(key, value);
        }
        key = value + std::strlen(value) + 1;
    }
    if (as_one_text && !text.empty()) {
        const size_t limit = 30000; // a JPEG marker holds less than 65,536 bytes
        spec.attribute("ImageDescription", text.substr(0, limit));
    }
    spec.attribute("DateTime", ""); // the same picture is the same file, whenever it is written
    spec.attribute("Software", "ramify");
}

bool encode(const char *file, const char *format, const OIIO::ImageSpec &spec, OIIO::TypeDesc type,
            const void *pixels, Bytes &bytes, Error *e)
{
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->supports("ioproxy")) {
        return error_set(e, ERROR_INTERNAL, "'%s' cannot be written: OpenImageIO has no %s writer",
                         file, format);
    }
    std::string name = std::string("memory.") + format;
    bool done = output->set_ioproxy(&proxy) && output->open(name, spec) &&
                output->write_image(type, pixels) && output->close();
    if (!done) {
        return error_set(e, ERROR_INTERNAL, "'%s' cannot be written: %s", file,
                         output->geterror().c_str());
    }
    return true;
}

// 8 bits; without_alpha: over black.
Bytes quantise_image(const Image *image, bool without_alpha)
{
    int channels = without_alpha ? 3 : image->channels;
    Bytes bytes(size_t(image->width) * size_t(image->height) * size_t(channels));
    size_t out = 0;
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            const float *p = image->pixel + (size_t(y) * size_t(image->width) + size_t(x)) *
                                                size_t(image->channels);
            float over = without_alpha && image->channels == 4 ? p[3] : 1.0f;
            for (int c = 0; c < channels; c++) {
                bytes[out++] =
                    c == 3 ? quantise_nearest(p[c]) : quantise_dithered(p[c] * over, x, y, c);
            }
        }
    }
    return bytes;
}

// The bytes of a PNG or JPEG, by the name's ending.
bool encode_display(const char *file, const Image *image, const char *metadata, Bytes &bytes,
                    Error *e)
{
    std::string extension = extension_of(file);
    bool jpeg = extension == "jpg" || extension == "jpeg";
    if (!jpeg && extension != "png") {
        return error_set(e, ERROR_INPUT,
                         "'%s' cannot be written: the name must end in .png, .jpg or .jpeg", file);
    }
    if (image->channels != 3 && image->channels != 4) {
        return error_set(e, ERROR_INPUT, "'%s' cannot be written: %d channels; 3 or 4 would do",
                         file, image->channels);
    }
    Bytes pixels = quantise_image(image, jpeg);
    OIIO::ImageSpec spec(image->width, image->height, jpeg ? 3 : image->channels,
                         OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (jpeg) {
        spec.attribute("CompressionQuality", 95);
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    add_metadata(spec, metadata, jpeg);
    return encode(file, jpeg ? "jpeg" : "png", spec, OIIO::TypeDesc::UINT8, pixels.data(), bytes,
                  e);
}

bool write_display(const char *file, const Image *image, const char *metadata, Error *e)
{
    Bytes bytes;
    return encode_display(file, image, metadata, bytes, e) &&
           file_replace(file, bytes.data(), bytes.size(), e);
}

bool write_grey16(const char *file, const Image *image, const char *metadata, Error *e)
{
    if (extension_of(file) != "png" || image->channels != 1) {
        return error_set(e, ERROR_INPUT,
                         "'%s' cannot be written: a 16-bit grey picture has one channel and a name "
                         "that ends in .png",
                         file);
    }
    OIIO::ImageSpec spec(image->width, image->height, 1, OIIO::TypeDesc::UINT16);
    spec.attribute("oiio:ColorSpace", "Linear"); // heights: no viewer may bend them
    add_metadata(spec, metadata, false);
    std::vector<uint16_t> pixels(size_t(image->width) * size_t(image->height));
    for (size_t i = 0; i < pixels.size(); i++) {
        float v = std::clamp(image->pixel[i], 0.0f, 1.0f);
        pixels[i] = uint16_t(v * 65535.0f + 0.5f);
    }
    Bytes bytes;
    return encode(file, "png", spec, OIIO::TypeDesc::UINT16, pixels.data(), bytes, e) &&
           file_replace(file, bytes.data(), bytes.size(), e);
}

bool check_layers(const char *file, const ImageLayer *layers, int count, Error *e)
{
    for (int i = 0; i < count; i++) {
        const Image *image = layers[i].image, *first = layers[0].image;
        if (image->width != first->width || image->height != first->height) {
            return error_set(e, ERROR_INPUT,
                             "'%s' cannot be written: layer '%s' is %d x %d, the first one %d x %d",
                             file, layers[i].name, image->width, image->height, first->width,
                             first->height);
        }
        if ((int)std::strlen(layers[i].channel_names) != image->channels) {
            return error_set(
                e, ERROR_INPUT,
                "'%s' cannot be written: layer '%s' has %d channels but the names '%s'", file,
                layers[i].name, image->channels, layers[i].channel_names);
        }
    }
    return count > 0 || error_set(e, ERROR_INPUT, "'%s' cannot be written: no layers", file);
}

bool write_exr(const char *file, const ImageLayer *layers, int count, const char *metadata,
               Error *e)
{
    if (!check_layers(file, layers, count, e)) {
        return false;
    }
    OIIO::ImageSpec spec(layers[0].image->width, layers[0].image->height, 0, OIIO::TypeDesc::FLOAT);
    for (int i = 0; i < count; i++) {
        std::string prefix = layers[i].name[0] ? std::string(layers[i].name) + "." : "";
        for (const char *c = layers[i].channel_names; *c; c++) {
            if (prefix.empty() && *c == 'A') {
                spec.alpha_channel = spec.nchannels;
            }
            spec.channelnames.push_back(prefix + *c);
            spec.nchannels++;
        }
    }
    size_t size = size_t(spec.width) * size_t(spec.height), channels = size_t(spec.nchannels);
    std::vector<float> pixels(size * channels);
    size_t offset = 0;
    for (int i = 0; i < count; i++) {
        size_t own = size_t(layers[i].image->channels);
        for (size_t p = 0; p < size; p++) {
            std::memcpy(&pixels[p * channels + offset], layers[i].image->pixel + p * own,
                        own * sizeof(float));
        }
        offset += own;
    }
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "lin_srgb");
    add_metadata(spec, metadata, false);
    Bytes bytes;
    return encode(file, "openexr", spec, OIIO::TypeDesc::FLOAT, pixels.data(), bytes, e) &&
           file_replace(file, bytes.data(), bytes.size(), e);
}

OIIO::ImageSpec as_stored()
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

// All of an open input; spec: what it holds. file: its name in messages.
bool read_open(OIIO::ImageInput *input, const char *file, Image **image, OIIO::ImageSpec *spec,
               Error *e)
{
    *spec = input->spec();
    if (spec->depth > 1 || spec->deep) {
        return error_set(e, ERROR_INPUT, "image '%s' cannot be read: it is not flat", file);
    }
    *image = image_new(spec->width, spec->height, spec->nchannels, e);
    if (!*image) {
        return false;
    }
    if (!input->read_image(0, 0, 0, spec->nchannels, OIIO::TypeDesc::FLOAT, (*image)->pixel)) {
        return error_set(e, ERROR_INPUT, "image '%s' cannot be read: %s", file,
                         input->geterror().c_str());
    }
    return true;
}

bool read(const char *file, Image **image, OIIO::ImageSpec *spec, Error *e)
{
    OIIO::ImageSpec config = as_stored();
    auto input = OIIO::ImageInput::open(file, &config);
    if (!input) {
        std::string reason = OIIO::geterror();
        return error_set(e, ERROR_INPUT, "image '%s' cannot be read: %s", file, reason.c_str());
    }
    return read_open(input.get(), file, image, spec, e);
}

bool decode_png(OIIO::Filesystem::IOProxy *proxy, Image **image, Error *e)
{
    static const char name[] = "memory.png";
    auto input = OIIO::ImageInput::create("png");
    OIIO::ImageSpec spec;
    if (!input || !input->set_ioproxy(proxy) || !input->open(name, spec, as_stored())) {
        return error_set(e, ERROR_INTERNAL, "a PNG in memory cannot be read: %s",
                         input ? input->geterror().c_str() : "OpenImageIO has no reader");
    }
    return read_open(input.get(), name, image, &spec, e);
}

// Some channels of an image, by index, in this order.
Image *pick_channels(const Image *image, const std::vector<int> &channels, Error *e)
{
    Image *picked = image_new(image->width, image->height, (int)channels.size(), e);
    size_t pixels = size_t(image->width) * size_t(image->height), out = 0;
    for (size_t p = 0; picked && p < pixels; p++) {
        for (int c : channels) {
            picked->pixel[out++] = image->pixel[p * size_t(image->channels) + size_t(c)];
        }
    }
    return picked;
}

// R, G, B and, where there is one, A of a file; grey, as three equal channels, where it has no R,
// G, B.
std::vector<int> color_channels(const OIIO::ImageSpec &spec)
{
    int red = spec.channelindex("R"), green = spec.channelindex("G"), blue = spec.channelindex("B");
    std::vector<int> channels = {red, green, blue};
    if (red < 0 || green < 0 || blue < 0) {
        bool grey = spec.nchannels < 3;
        channels = {0, grey ? 0 : 1, grey ? 0 : 2};
    }
    if (spec.alpha_channel >= 0) {
        channels.push_back(spec.alpha_channel);
    }
    return channels;
}

bool is_linear(const OIIO::ImageSpec &spec)
{
    return spec.format == OIIO::TypeDesc::FLOAT || spec.format == OIIO::TypeDesc::HALF;
}

// Reads, then makes of what was read what is wanted; frees the former.
template <typename Make> Image *read_and_make(const char *file, Error *e, Make make)
{
    Image *image = nullptr, *made = nullptr;
    guarded("image '" + std::string(file) + "' cannot be read", e, [&] {
        OIIO::ImageSpec spec;
        if (read(file, &image, &spec, e)) {
            made = make(image, spec);
        }
        return made != nullptr;
    });
    image_free(image);
    return made;
}

// JPEGs carry all pairs as lines of one text: see add_metadata.
std::string find_text(const OIIO::ImageSpec &spec, const std::string &key)
{
    std::string value = spec.get_string_attribute(key);
    std::string lines = "\n" + std::string(spec.get_string_attribute("ImageDescription"));
    size_t at = lines.find("\n" + key + ": ");
    if (value.empty() && at != std::string::npos) {
        at += key.size() + 3;
        value = lines.substr(at, lines.find('\n', at) - at);
    }
    return value;
}

bool read_text(const char *file, const char *key, char *text, int size)
{
    auto input = OIIO::ImageInput::open(file);
    if (!input) {
        OIIO::geterror(); // or it would be told on stderr at the end
        return false;
    }
    const OIIO::ImageSpec spec = input->spec();
    std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels));
    std::string value = find_text(spec, key);
    bool whole = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()) &&
                 input->geterror().empty();
    std::snprintf(text, size_t(size), "%s", value.c_str());
    return whole && !value.empty();
}

} // namespace

extern "C" bool image_read_text(const char *file, const char *key, char *text, int size)
{
    Error unused = {};
    return guarded(file, &unused, [&] { return read_text(file, key, text, size); });
}

extern "C" Image *image_read(const char *file, Error *e)
{
    Image *image = nullptr;
    bool done = guarded("image '" + std::string(file) + "' cannot be read", e, [&] {
        OIIO::ImageSpec spec;
        return read(file, &image, &spec, e);
    });
    if (!done) {
        image_free(image);
        return nullptr;
    }
    return image;
}

extern "C" Image *image_read_color(const char *file, bool *linear, Error *e)
{
    return read_and_make(file, e, [&](const Image *image, const OIIO::ImageSpec &spec) {
        *linear = is_linear(spec);
        return pick_channels(image, color_channels(spec), e);
    });
}

extern "C" Image *image_read_layer(const char *file, const char *layer, const char *channels,
                                   Error *e)
{
    return read_and_make(file, e, [&](const Image *image, const OIIO::ImageSpec &spec) -> Image * {
        std::vector<int> picked;
        for (const char *c = channels; *c; c++) {
            std::string name = (layer[0] ? std::string(layer) + "." : "") + *c;
            picked.push_back(spec.channelindex(name));
            if (picked.back() < 0) {
                error_set(e, ERROR_INPUT, "image '%s' has no channel '%s'", file, name.c_str());
                return nullptr;
            }
        }
        return pick_channels(image, picked, e);
    });
}

extern "C" Image *image_decode_png(const unsigned char *bytes, size_t size, Error *e)
{
    Image *image = nullptr;
    bool done = guarded("a PNG in memory cannot be read", e, [&] {
        OIIO::Filesystem::IOMemReader proxy(const_cast<unsigned char *>(bytes), size);
        return decode_png(&proxy, &image, e);
    });
    if (!done) {
        image_free(image);
        return nullptr;
    }
    return image;
}

extern "C" bool image_encode_png(const Image *image, const char *metadata, unsigned char **bytes,
                                 size_t *size, Error *e)
{
    return guarded("a picture cannot be made a PNG", e, [&] {
        Bytes encoded;
        if (!encode_display("memory.png", image, metadata, encoded, e)) {
            return false;
        }
        *bytes = (unsigned char *)memory_alloc((int64_t)encoded.size(), 1, e);
        *size = encoded.size();
        return *bytes && std::memcpy(*bytes, encoded.data(), encoded.size());
    });
}

extern "C" bool image_write_display(const char *file, const Image *image, const char *metadata,
                                    Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_display(file, image, metadata, e); });
}

extern "C" bool image_write_exr(const char *file, const ImageLayer *layers, int count,
                                const char *metadata, Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_exr(file, layers, count, metadata, e); });
}

extern "C" bool image_write_grey16(const char *file, const Image *image, const char *metadata,
                                   Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_grey16(file, image, metadata, e); });
}
