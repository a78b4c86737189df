// Lays pictures out for their formats.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "image/encode_bytes.h"
#include "image/encode_exr.h"

extern "C" {
#include "image/codec.h"
#include "image/decode.h"
#include "image/encode.h"
#include "image/quantise.h"
}

namespace
{

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

bool check_channels(const Image *image, Error *e)
{
    return image->channels == 3 || image->channels == 4 ||
           error_set(e, ERROR_INPUT, "%d channels; 3 or 4 would do", image->channels);
}

OIIO::ImageSpec display_spec(const Image *image, int channels, OIIO::TypeDesc type)
{
    OIIO::ImageSpec spec(image->width, image->height, channels, type);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return spec;
}

// A PNG or JPEG, by the file name's extension.
bool encode_display(const EncodeJob &job, Bytes &bytes, Error *e)
{
    std::string extension = extension_of(job.file);
    bool jpeg = extension == "jpg" || extension == "jpeg";
    if (!jpeg && extension != "png") {
        return error_set(e, ERROR_INPUT, "the name must end in .png, .jpg or .jpeg");
    }
    const Image *image = job.image;
    if (!check_channels(image, e)) {
        return false;
    }
    Bytes pixels = quantise_image(image, jpeg);
    OIIO::ImageSpec spec = display_spec(image, jpeg ? 3 : image->channels, OIIO::TypeDesc::UINT8);
    if (jpeg) {
        spec.attribute("CompressionQuality", 95);
        spec.attribute("jpeg:subsampling", "4:4:4");
        add_description(spec, job.metadata);
    }
    return encode({jpeg ? "jpeg" : "png", spec, pixels.data(), job.metadata}, bytes, e);
}

// A PNG of 16 bits with all channels of the image.
bool encode_png16(const EncodeJob &job, OIIO::ImageSpec &spec, Bytes &bytes, Error *e)
{
    const Image *image = job.image;
    std::vector<uint16_t> pixels = quantise_16(
        image->pixel, size_t(image->width) * size_t(image->height) * size_t(image->channels));
    return encode({"png", spec, pixels.data(), job.metadata}, bytes, e);
}

bool encode_display16(const EncodeJob &job, Bytes &bytes, Error *e)
{
    if (extension_of(job.file) != "png") {
        return error_set(e, ERROR_INPUT, "a picture of 16 bits must be named .png");
    }
    if (!check_channels(job.image, e)) {
        return false;
    }
    OIIO::ImageSpec spec = display_spec(job.image, job.image->channels, OIIO::TypeDesc::UINT16);
    return encode_png16(job, spec, bytes, e);
}

bool encode_grey16(const EncodeJob &job, Bytes &bytes, Error *e)
{
    if (extension_of(job.file) != "png" || job.image->channels != 1) {
        return error_set(e, ERROR_INPUT,
                         "a 16-bit grey picture has one channel and a name that ends in .png");
    }
    OIIO::ImageSpec spec(job.image->width, job.image->height, 1, OIIO::TypeDesc::UINT16);
    spec.attribute("oiio:ColorSpace", "Linear"); // prevents viewers from applying a curve to
                                                 // heights
    return encode_png16(job, spec, bytes, e);
}

bool encode_kind(const EncodeJob &job, Bytes &bytes, Error *e)
{
    switch (job.kind) {
    case ENCODE_DISPLAY16:
        return encode_display16(job, bytes, e);
    case ENCODE_GREY16:
        return encode_grey16(job, bytes, e);
    case ENCODE_EXR:
        return encode_exr(job, bytes, e);
    default:
        return encode_display(job, bytes, e);
    }
}

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

extern "C" bool encode_picture(const void *data, ChildOutput *output, Error *e)
{
    try {
        Bytes bytes;
        return encode_kind(*static_cast<const EncodeJob *>(data), bytes, e) &&
               child_write(output, bytes.data(), int64_t(bytes.size()), 1, e);
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory");
    } catch (const std::exception &failure) {
        return error_set(e, ERROR_INTERNAL, "%s", failure.what());
    } catch (...) {
        return error_set(e, ERROR_INTERNAL, "its writer failed for no known reason");
    }
}

extern "C" const ImageCodec image_codec_oiio;
const ImageCodec image_codec_oiio = {sizeof(ImageCodec), decode_picture, encode_picture};
