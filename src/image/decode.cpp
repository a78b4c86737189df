// Decodes a picture in a child process through OpenImageIO and returns its pixels in blocks of
// rows, so that only one block is in memory if the format is read row by row.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

extern "C" {
#include "image/codec.h"
#include "image/decode.h"
}

namespace
{

const size_t BLOCK_BYTES = 64 << 20;
const int MAX_BLOCK_ROWS = 256,
          MIN_BLOCK_ROWS = 16; // a multiple of the rows that formats compress together
const int MAX_CHANNELS = 1024;

// Indices of the requested channels, in order.
using Channels = std::vector<int>;

// R, G, B and, if present, A of a file; grey as three equal channels if it has no R, G, B.
Channels color_channels(const OIIO::ImageSpec &spec)
{
    int red = spec.channelindex("R"), green = spec.channelindex("G"), blue = spec.channelindex("B");
    Channels channels = {red, green, blue};
    if (red < 0 || green < 0 || blue < 0) {
        bool grey = spec.nchannels < 3;
        channels = {0, grey ? 0 : 1, grey ? 0 : 2};
    }
    if (spec.alpha_channel >= 0) {
        channels.push_back(spec.alpha_channel);
    }
    return channels;
}

bool layer_channels(const OIIO::ImageSpec &spec, const DecodeJob *job, Channels &channels, Error *e)
{
    for (const char *c = job->channels; *c; c++) {
        std::string name = (job->layer[0] ? std::string(job->layer) + "." : "") + *c;
        channels.push_back(spec.channelindex(name));
        if (channels.back() < 0) {
            return error_set(e, ERROR_INPUT, "it has no channel '%s'", name.c_str());
        }
    }
    return true;
}

bool named_channels(const OIIO::ImageSpec &spec, const DecodeJob *job, Channels &channels, Error *e)
{
    for (int i = 0; i < job->count; i++) {
        channels.push_back(spec.channelindex(job->names[i]));
        if (channels.back() < 0) {
            return error_set(e, ERROR_INPUT, "it has no channel '%s'", job->names[i]);
        }
    }
    return true;
}

bool choose_channels(const OIIO::ImageSpec &spec, const DecodeJob *job, Channels &channels,
                     Error *e)
{
    if (job->kind == DECODE_LAYER) {
        return layer_channels(spec, job, channels, e);
    }
    if (job->kind == DECODE_NAMED) {
        return named_channels(spec, job, channels, e);
    }
    if (job->kind == DECODE_COLOR) {
        channels = color_channels(spec);
        return true;
    }
    for (int c = 0; c < spec.nchannels; c++) {
        channels.push_back(c);
    }
    return true;
}

TexelType texel_type(const OIIO::ImageSpec &spec, DecodeKind kind)
{
    if (kind != DECODE_TEXTURE) {
        return TEXEL_FLOAT;
    }
    return spec.format == OIIO::TypeDesc::UINT8    ? TEXEL_BYTE
           : spec.format == OIIO::TypeDesc::UINT16 ? TEXEL_SHORT
           : spec.format == OIIO::TypeDesc::HALF   ? TEXEL_HALF
                                                   : TEXEL_FLOAT;
}

OIIO::TypeDesc type_desc(TexelType type)
{
    return type == TEXEL_BYTE    ? OIIO::TypeDesc::UINT8
           : type == TEXEL_SHORT ? OIIO::TypeDesc::UINT16
           : type == TEXEL_HALF  ? OIIO::TypeDesc::HALF
                                 : OIIO::TypeDesc::FLOAT;
}

bool check_size(const OIIO::ImageSpec &spec, Error *e)
{
    int64_t width = spec.width, height = spec.height;
    if (spec.depth > 1 || spec.deep) {
        return error_set(e, ERROR_INPUT, "it is not flat; one layer of pixels is needed");
    }
    if (width < 1 || height < 1 || spec.nchannels < 1) {
        return error_set(e, ERROR_INPUT, "it has no pixels");
    }
    if (spec.nchannels > MAX_CHANNELS) {
        return error_set(e, ERROR_INPUT, "it has %d channels; at most %d are read", spec.nchannels,
                         MAX_CHANNELS);
    }
    return width * height <= DECODE_MAX_PIXELS ||
           error_set(e, ERROR_INPUT,
                     "it has %lld x %lld pixels; at most %d are read, as of 16384 x 8192: make it "
                     "smaller",
                     (long long)width, (long long)height, DECODE_MAX_PIXELS);
}

bool check_bytes(const DecodeHeader *h, Error *e)
{
    int64_t bytes = (int64_t)h->width * h->height * h->channels * texel_bytes((TexelType)h->type);
    return bytes <= DECODE_MAX_BYTES ||
           error_set(e, ERROR_INPUT,
                     "its %d x %d pixels of %d channels take %.3g GB; at most %.3g GB are read: "
                     "make it smaller",
                     h->width, h->height, h->channels, (double)bytes * 1e-9,
                     (double)DECODE_MAX_BYTES * 1e-9);
}

// JPEG files store all pairs as lines of one text: see image/encode_jpeg.c.
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

DecodeHeader header_of(const OIIO::ImageSpec &spec, const DecodeJob *job, int channels)
{
    DecodeHeader h = {};
    h.width = spec.width;
    h.height = spec.height;
    h.channels = channels;
    h.type = texel_type(spec, job->kind);
    h.linear = spec.format == OIIO::TypeDesc::FLOAT || spec.format == OIIO::TypeDesc::HALF;
    const int window[6] = {spec.x,      spec.y,          spec.full_x,
                           spec.full_y, spec.full_width, spec.full_height};
    std::copy(window, window + 6, h.window);
    if (job->kind == DECODE_TEXT) {
        std::snprintf(h.text, sizeof h.text, "%s", find_text(spec, job->key).c_str());
    }
    return h;
}

// ---- pixels ----

// Rows of pixels as read: the channels from first to last.
struct Block {
    int first, count; // channels
    size_t channel_bytes;
    std::vector<char> pixels, picked;
};

bool read_rows(OIIO::ImageInput *input, const OIIO::ImageSpec &spec, int begin, int end,
               OIIO::TypeDesc type, Block &block, Error *e)
{
    int last = block.first + block.count;
    bool read = spec.tile_width > 0
                    ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z,
                                        spec.z + 1, block.first, last, type, block.pixels.data())
                    : input->read_scanlines(0, 0, begin, end, spec.z, block.first, last, type,
                                            block.pixels.data());
    std::string reason = input->geterror();
    return (read && reason.empty()) ||
           error_set(e, ERROR_INPUT, "%s", reason.empty() ? "it is cut short" : reason.c_str());
}

// Reduces each pixel to the requested channels, in order.
const char *pick(Block &block, const Channels &channels, size_t pixels)
{
    bool all = (int)channels.size() == block.count;
    for (size_t c = 0; all && c < channels.size(); c++) {
        all = channels[c] == block.first + (int)c;
    }
    if (all) {
        return block.pixels.data();
    }
    size_t bytes = block.channel_bytes, from_step = bytes * size_t(block.count);
    char *to = block.picked.data();
    for (size_t p = 0; p < pixels; p++) {
        for (int c : channels) {
            const char *from =
                block.pixels.data() + p * from_step + bytes * size_t(c - block.first);
            to = std::copy(from, from + bytes, to);
        }
    }
    return block.picked.data();
}

int rows_at_once(const OIIO::ImageSpec &spec, size_t row_bytes)
{
    if (spec.tile_width > 0) {
        return spec.tile_height;
    }
    int rows = MAX_BLOCK_ROWS;
    while (rows > MIN_BLOCK_ROWS && size_t(rows) * row_bytes > BLOCK_BYTES) {
        rows /= 2;
    }
    return rows;
}

bool hand_back(OIIO::ImageInput *input, const OIIO::ImageSpec &spec, const DecodeJob *job,
               const Channels &channels, TexelType type, ChildOutput *output, Error *e)
{
    auto ends = std::minmax_element(channels.begin(), channels.end());
    Block block = {*ends.first, *ends.second - *ends.first + 1, size_t(texel_bytes(type)), {}, {}};
    size_t pixel_bytes = block.channel_bytes * size_t(block.count), width = size_t(spec.width);
    int rows = std::min(rows_at_once(spec, width * pixel_bytes), spec.height);
    block.pixels.resize(size_t(rows) * width * pixel_bytes);
    block.picked.resize(size_t(rows) * width * block.channel_bytes * channels.size());
    for (int y = 0; y < spec.height; y += rows) {
        int end = std::min(y + rows, spec.height);
        size_t pixels = size_t(end - y) * width;
        if (!read_rows(input, spec, spec.y + y, spec.y + end, type_desc(type), block, e)) {
            return false;
        }
        if (job->kind != DECODE_TEXT &&
            !child_write(output, pick(block, channels, pixels), (int64_t)(pixels * channels.size()),
                         block.channel_bytes, e)) {
            return false;
        }
    }
    return true;
}

bool hand_metadata(const OIIO::ImageSpec &spec, const DecodeJob *job, DecodeHeader *header,
                   ChildOutput *output, Error *e)
{
    std::string text = find_text(spec, job->key);
    if (text.empty() || text.size() > DECODE_METADATA_SIZE) {
        return error_set(e, ERROR_INPUT, "it has no text '%s'", job->key);
    }
    header->metadata = (int32_t)text.size();
    return child_write(output, header, 1, sizeof *header, e) &&
           child_write(output, text.data(), header->metadata, 1, e);
}

// A PNG.
std::unique_ptr<OIIO::ImageInput> open_memory(const DecodeJob *job, const OIIO::ImageSpec &config,
                                              OIIO::Filesystem::IOMemReader &memory)
{
    auto input = OIIO::ImageInput::create("png");
    OIIO::ImageSpec spec;
    bool open = input && input->set_ioproxy(&memory) && input->open(job->file, spec, config);
    return open ? std::move(input) : nullptr;
}

bool decode(const DecodeJob *job, ChildOutput *output, Error *e)
{
    // the threads of the forking process do not exist here
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    OIIO::ImageSpec config;
    if (job->kind != DECODE_TEXTURE) { // textures are filtered, so they stay multiplied by alpha
        config.attribute("oiio:UnassociatedAlpha", 1);
    }
    OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char *>(job->bytes), job->size);
    auto input =
        job->bytes ? open_memory(job, config, memory) : OIIO::ImageInput::open(job->file, &config);
    if (!input) {
        return error_set(e, ERROR_INPUT, "%s", OIIO::geterror().c_str());
    }
    input->threads(1);
    const OIIO::ImageSpec spec = input->spec();
    Channels channels;
    if (!check_size(spec, e) || !choose_channels(spec, job, channels, e)) {
        return false;
    }
    DecodeHeader header = header_of(spec, job, (int)channels.size());
    if (job->kind == DECODE_METADATA) {
        return hand_metadata(spec, job, &header, output, e);
    }
    return (job->kind == DECODE_TEXT || check_bytes(&header, e)) &&
           child_write(output, &header, 1, sizeof header, e) &&
           hand_back(input.get(), spec, job, channels, (TexelType)header.type, output, e);
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

extern "C" bool decode_picture(const void *data, ChildOutput *output, Error *e)
{
    try {
        return decode(static_cast<const DecodeJob *>(data), output, e);
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory");
    } catch (const std::exception &failure) {
        return error_set(e, ERROR_INPUT, "%s", failure.what());
    } catch (...) {
        return error_set(e, ERROR_INPUT, "its reader failed for no known reason");
    }
}

extern "C" const ImageReader image_reader_oiio;
const ImageReader image_reader_oiio = {sizeof(ImageReader), decode_picture};
