// Encodes pictures in memory by OpenImageIO and writes them with file_replace, so that every write
// error is detected.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "image/encode_guard.h"
#include "image/png_text.h"

extern "C" {
#include "base/file_replace.h"
#include "base/memory.h"
#include "image/codec.h"
#include "image/decode.h"
#include "image/encode_exr.h"
#include "image/quantise.h"
}

namespace
{

const size_t ROOM_FOR_HEADER = 1 << 20;

std::string extension_of(const char *file)
{
    std::string extension = OIIO::Filesystem::extension(file, false);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    return extension;
}

// All pairs as one text, for JPEG, which has no free attributes. It is cut: a marker holds less
// than 65,536 bytes.
void add_description(OIIO::ImageSpec &spec, const char *metadata)
{
    const size_t limit = 30000;
    std::string text;
    for (const char *key = metadata; key && *key;) {
        const char *value = key + std::strlen(key) + 1;
        text += std::string(key) + ": " + value + "\n";
        key = value + std::strlen(value) + 1;
    }
    if (!text.empty()) {
        spec.attribute("ImageDescription", text.substr(0, limit));
    }
}

// OpenImageIO collects a line for each thing that fails after the first.
std::string first_line(const std::string &text)
{
    return text.substr(0, text.find('\n'));
}

// metadata: of a PNG. Its texts are not OpenImageIO's attributes, which would stay in memory until
// the process ends.
bool encode(const char *file, const char *format, OIIO::ImageSpec &spec, const char *metadata,
            const void *pixels, Bytes &bytes, Error *e)
{
    // Room for all: libjpeg and libpng cannot bear an exception while they write.
    bytes.reserve(size_t(spec.image_bytes()) + ROOM_FOR_HEADER);
    spec.attribute("DateTime", ""); // no time stamp: equal pictures give equal files
    spec.attribute("Software", "ramify");
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    OIIO::attribute("threads", 1); // none that a child process could wait for (base/child.h)
    OIIO::attribute("debug", 0);   // errors are ours to tell
    auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->supports("ioproxy")) {
        return error_set(e, ERROR_INTERNAL, "'%s' cannot be written: OpenImageIO has no %s writer",
                         file, format);
    }
    std::string name = std::string("memory.") + format;
    bool done = output->set_ioproxy(&proxy) && output->open(name, spec) &&
                output->write_image(spec.format, pixels) && output->close();
    if (!done) {
        return error_set(e, ERROR_INTERNAL, "'%s' cannot be written: %s", file,
                         first_line(output->geterror()).c_str());
    }
    png_add_texts(bytes, metadata);
    return true;
}

// 8 bits; without_alpha: composited over black.
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

std::vector<uint16_t> quantise_16(const float *value, size_t count)
{
    std::vector<uint16_t> shorts(count);
    for (size_t i = 0; i < count; i++) {
        float v = value[i] > 0.0f ? std::min(value[i], 1.0f) : 0.0f; // NaN becomes 0
        shorts[i] = uint16_t(v * 65535.0f + 0.5f);
    }
    return shorts;
}

bool check_channels(const char *file, const Image *image, Error *e)
{
    return image->channels == 3 || image->channels == 4 ||
           error_set(e, ERROR_INPUT, "'%s' cannot be written: %d channels; 3 or 4 would do", file,
                     image->channels);
}

OIIO::ImageSpec display_spec(const Image *image, int channels, OIIO::TypeDesc type)
{
    OIIO::ImageSpec spec(image->width, image->height, channels, type);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return spec;
}

// Encodes a PNG or JPEG, by the file name's extension.
bool encode_display(const char *file, const Image *image, const char *metadata, Bytes &bytes,
                    Error *e)
{
    std::string extension = extension_of(file);
    bool jpeg = extension == "jpg" || extension == "jpeg";
    if (!jpeg && extension != "png") {
        return error_set(e, ERROR_INPUT,
                         "'%s' cannot be written: the name must end in .png, .jpg or .jpeg", file);
    }
    if (!check_channels(file, image, e)) {
        return false;
    }
    Bytes pixels = quantise_image(image, jpeg);
    OIIO::ImageSpec spec = display_spec(image, jpeg ? 3 : image->channels, OIIO::TypeDesc::UINT8);
    if (jpeg) {
        spec.attribute("CompressionQuality", 95);
        spec.attribute("jpeg:subsampling", "4:4:4");
        add_description(spec, metadata);
    }
    return encode(file, jpeg ? "jpeg" : "png", spec, jpeg ? nullptr : metadata, pixels.data(),
                  bytes, e);
}

bool write_display(const char *file, const Image *image, const char *metadata, Error *e)
{
    Bytes bytes;
    return encode_display(file, image, metadata, bytes, e) &&
           file_replace(file, bytes.data(), bytes.size(), e);
}

bool write_display16(const char *file, const Image *image, const char *metadata, Error *e)
{
    if (extension_of(file) != "png") {
        return error_set(e, ERROR_INPUT,
                         "'%s' cannot be written: a picture of 16 bits must be named .png", file);
    }
    if (!check_channels(file, image, e)) {
        return false;
    }
    OIIO::ImageSpec spec = display_spec(image, image->channels, OIIO::TypeDesc::UINT16);
    std::vector<uint16_t> pixels = quantise_16(
        image->pixel, size_t(image->width) * size_t(image->height) * size_t(image->channels));
    Bytes bytes;
    return encode(file, "png", spec, metadata, pixels.data(), bytes, e) &&
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
    spec.attribute("oiio:ColorSpace", "Linear"); // prevents viewers from applying a curve to
                                                 // heights
    std::vector<uint16_t> pixels =
        quantise_16(image->pixel, size_t(image->width) * size_t(image->height));
    Bytes bytes;
    return encode(file, "png", spec, metadata, pixels.data(), bytes, e) &&
           file_replace(file, bytes.data(), bytes.size(), e);
}

// Only for our own PNGs, so without a child process.
bool decode_png(OIIO::Filesystem::IOProxy *proxy, Image **image, Error *e)
{
    static const char name[] = "memory.png";
    auto input = OIIO::ImageInput::create("png");
    OIIO::ImageSpec spec;
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); // keep alpha straight, as stored
    if (!input || !input->set_ioproxy(proxy) || !input->open(name, spec, config)) {
        return error_set(e, ERROR_INTERNAL, "a PNG in memory cannot be read: %s",
                         input ? input->geterror().c_str() : "OpenImageIO has no reader");
    }
    *image = image_new(spec.width, spec.height, spec.nchannels, e);
    return *image &&
           (input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, (*image)->pixel) ||
            error_set(e, ERROR_INTERNAL, "a PNG in memory cannot be read: %s",
                      input->geterror().c_str()));
}

Image *decode_png_bytes(const unsigned char *bytes, size_t size, Error *e)
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

bool encode_png(const Image *image, const char *metadata, unsigned char **bytes, size_t *size,
                Error *e)
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

bool guarded_display(const char *file, const Image *image, const char *metadata, Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_display(file, image, metadata, e); });
}

bool guarded_display16(const char *file, const Image *image, const char *metadata, Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_display16(file, image, metadata, e); });
}

bool guarded_grey16(const char *file, const Image *image, const char *metadata, Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_grey16(file, image, metadata, e); });
}

} // namespace

namespace
{

// When it runs out of memory while it lists its formats, OpenImageIO waits for itself for ever. So
// it lists them when this is loaded, which is tried only with enough room (base/plugin.c).
struct Formats {
    Formats()
    {
        try {
            OIIO::attribute("threads", 1);
            OIIO::get_string_attribute("format_list");
        } catch (const std::exception &) { // it tries again when it needs them
        }
    }
} const formats;

} // namespace

extern "C" const ImageCodec image_codec_oiio;
const ImageCodec image_codec_oiio = {sizeof(ImageCodec), decode_picture,  guarded_display,
                                     guarded_display16,  guarded_grey16,  encode_exr,
                                     encode_png,         decode_png_bytes};
