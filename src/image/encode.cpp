// Encodes pictures in memory by OpenImageIO and writes them with file_replace, so that every write
// error is detected.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

extern "C" {
#include "base/file_replace.h"
#include "base/memory.h"
#include "image/codec.h"
#include "image/decode.h"
#include "image/quantise.h"
}

namespace
{

using Bytes = std::vector<unsigned char>;

const size_t ROOM_FOR_METADATA = 1 << 20;

// Runs body and converts exceptions to an Error. what: "'x.png' cannot be written"
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

// Adds the pairs as attributes; as one text for formats without free attributes.
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
    spec.attribute("DateTime", ""); // no time stamp: equal pictures give equal files
    spec.attribute("Software", "ramify");
}

// OpenEXR's threads exist while a picture is written and never beside a child process that reads
// one (base/child.h): threads are not forked, and the child would wait for them for ever.
class ExrThreads
{
  public:
    ExrThreads()
    {
        Imf::setGlobalThreadCount(int(std::thread::hardware_concurrency()));
    }
    ~ExrThreads()
    {
        Imf::setGlobalThreadCount(0);
    }
    ExrThreads(const ExrThreads &) = delete;
    ExrThreads &operator=(const ExrThreads &) = delete;
};

// OpenImageIO collects a line for each thing that fails after the first.
std::string first_line(const std::string &text)
{
    return text.substr(0, text.find('\n'));
}

bool encode(const char *file, const char *format, const OIIO::ImageSpec &spec, OIIO::TypeDesc type,
            const void *pixels, Bytes &bytes, Error *e)
{
    // Room for all: libjpeg and libpng cannot bear an exception while they write.
    bytes.reserve(size_t(spec.image_bytes()) + ROOM_FOR_METADATA);
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    OIIO::attribute("threads", 1); // nor are OpenImageIO's own, see ExrThreads
    OIIO::attribute("debug", 0);   // errors are ours to tell
    std::optional<ExrThreads> threads;
    if (std::strcmp(format, "openexr") == 0) {
        threads.emplace();
    }
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
                         first_line(output->geterror()).c_str());
    }
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
    add_metadata(spec, metadata, false);
    std::vector<uint16_t> pixels = quantise_16(
        image->pixel, size_t(image->width) * size_t(image->height) * size_t(image->channels));
    Bytes bytes;
    return encode(file, "png", spec, OIIO::TypeDesc::UINT16, pixels.data(), bytes, e) &&
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
    add_metadata(spec, metadata, false);
    std::vector<uint16_t> pixels =
        quantise_16(image->pixel, size_t(image->width) * size_t(image->height));
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

// Channels of all layers, pixel by pixel, of the spec's window.
std::vector<float> interleave(const OIIO::ImageSpec &spec, const ImageLayer *layers, int count)
{
    size_t width = size_t(spec.width), channels = size_t(spec.nchannels), offset = 0;
    std::vector<float> pixels(width * size_t(spec.height) * channels);
    for (int i = 0; i < count; i++) {
        const Image *image = layers[i].image;
        size_t own = size_t(image->channels);
        for (size_t y = 0; y < size_t(spec.height); y++) {
            const float *row =
                image->pixel + ((size_t(spec.y) + y) * size_t(image->width) + size_t(spec.x)) * own;
            for (size_t x = 0; x < width; x++) {
                std::memcpy(&pixels[(y * width + x) * channels + offset], row + x * own,
                            own * sizeof(float));
            }
        }
        offset += own;
    }
    return pixels;
}

// An EXR file in memory, for OpenEXR to look into.
class ExrBytes : public Imf::IStream
{
  public:
    explicit ExrBytes(const Bytes &bytes) : IStream("memory.exr"), all(bytes)
    {
    }
    bool read(char target[], int count) override
    {
        if (count < 0 || size_t(count) > all.size() - at) {
            throw std::runtime_error("the end is missing");
        }
        std::memcpy(target, all.data() + at, size_t(count));
        at += size_t(count);
        return at < all.size();
    }
    uint64_t tellg() override
    {
        return at;
    }
    void seekg(uint64_t to) override
    {
        at = std::min(size_t(to), all.size());
    }

  private:
    const Bytes &all;
    size_t at = 0;
};

// Neither an attribute nor lines of pixels that could not be written for lack of memory are an
// error to OpenImageIO and OpenEXR: they are left out. This reads the header and the table of lines
// only.
bool check_exr(const char *file, const Bytes &bytes, const char *metadata, Error *e)
{
    ExrBytes stream(bytes);
    Imf::InputFile input(stream, 0);
    bool whole = input.isComplete();
    for (const char *key : {"Software", "capDate"}) { // of add_metadata
        whole = whole && input.header().find(key) != input.header().end();
    }
    for (const char *key = metadata; key && *key; key += std::strlen(key) + 1) {
        whole = whole && input.header().find(key) != input.header().end();
        key += std::strlen(key) + 1; // over the value
    }
    return whole || error_set(e, ERROR_MEMORY, "'%s' cannot be written: out of memory", file);
}

bool write_exr(const char *file, const ImageLayer *layers, int count, const int *window,
               const char *metadata, Error *e)
{
    if (!check_layers(file, layers, count, e)) {
        return false;
    }
    OIIO::ImageSpec spec(layers[0].image->width, layers[0].image->height, 0, OIIO::TypeDesc::FLOAT);
    if (window) { // the spec's full size stays
        spec.x = window[0];
        spec.y = window[1];
        spec.width = window[2];
        spec.height = window[3];
    }
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
    std::vector<float> pixels = interleave(spec, layers, count);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "lin_srgb");
    add_metadata(spec, metadata, false);
    Bytes bytes;
    return encode(file, "openexr", spec, OIIO::TypeDesc::FLOAT, pixels.data(), bytes, e) &&
           check_exr(file, bytes, metadata, e) && file_replace(file, bytes.data(), bytes.size(), e);
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

bool guarded_exr(const char *file, const ImageLayer *layers, int count, const int *window,
                 const char *metadata, Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_exr(file, layers, count, window, metadata, e); });
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
                                     guarded_display16,  guarded_grey16,  guarded_exr,
                                     encode_png,         decode_png_bytes};
