// Writes EXR pictures by OpenEXR itself: planes are read where they lie, and OpenImageIO would keep
// each text of the metadata until the process ends.
#include "image/encode_exr.h"
#include "image/encode_guard.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <thread>

extern "C" {
#include "base/file_replace.h"
}

namespace
{

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

// An EXR file in memory that is being written.
class ExrOutput : public Imf::OStream
{
  public:
    explicit ExrOutput(Bytes &bytes) : OStream("memory.exr"), all(bytes)
    {
    }
    void write(const char source[], int count) override
    {
        size_t end = at + size_t(count);
        if (end > all.size()) {
            all.resize(end);
        }
        std::memcpy(all.data() + at, source, size_t(count));
        at = end;
    }
    uint64_t tellp() override
    {
        return at;
    }
    void seekp(uint64_t to) override
    {
        at = size_t(to);
    }

  private:
    Bytes &all;
    size_t at = 0;
};

// An EXR file in memory, for OpenEXR to look into.
class ExrInput : public Imf::IStream
{
  public:
    explicit ExrInput(const Bytes &bytes) : IStream("memory.exr"), all(bytes)
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

// The window of the picture, in which pixels are written; OpenEXR counts to the last one.
Imf::Header make_header(const Image *image, const int *window, const char *metadata)
{
    const Imath::Box2i whole({0, 0}, {image->width - 1, image->height - 1});
    Imath::Box2i data = whole;
    if (window) {
        data = {{window[0], window[1]}, {window[0] + window[2] - 1, window[1] + window[3] - 1}};
    }
    Imf::Header header(whole, data, 1.0f, {0.0f, 0.0f}, 1.0f, Imf::INCREASING_Y,
                       Imf::ZIP_COMPRESSION);
    header.insert("Software", Imf::StringAttribute("ramify"));
    header.insert("capDate", Imf::StringAttribute("")); // equal pictures give equal files
    for (const char *key = metadata; key && *key;) {
        const char *value = key + std::strlen(key) + 1;
        header.insert(key, Imf::StringAttribute(value));
        key = value + std::strlen(value) + 1;
    }
    return header;
}

// Adds the layers' channels, which stay where they are.
void add_channels(const ImageLayer *layers, int count, Imf::Header &header, Imf::FrameBuffer &frame)
{
    for (int i = 0; i < count; i++) {
        const Image *image = layers[i].image;
        size_t pixel = sizeof(float) * size_t(image->channels), row = pixel * size_t(image->width);
        for (int c = 0; c < image->channels; c++) {
            std::string name = layers[i].name[0] ? std::string(layers[i].name) + "." : "";
            name += layers[i].channel_names[c];
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice(Imf::FLOAT, (char *)(image->pixel + c), pixel, row));
        }
    }
}

// Lines of pixels that could not be written for lack of memory are no error to OpenEXR: they are
// left out. This reads the header and the table of lines only.
bool is_whole(const Bytes &bytes)
{
    ExrInput stream(bytes);
    return Imf::InputFile(stream, 0).isComplete();
}

bool write_exr(const char *file, const ImageLayer *layers, int count, const int *window,
               const char *metadata, Error *e)
{
    if (!check_layers(file, layers, count, e)) {
        return false;
    }
    Bytes bytes;
    {
        Imf::Header header = make_header(layers[0].image, window, metadata);
        Imf::FrameBuffer frame;
        add_channels(layers, count, header, frame);
        const Imath::Box2i &data = header.dataWindow();
        ExrOutput stream(bytes);
        ExrThreads threads;
        Imf::OutputFile output(stream, header);
        output.setFrameBuffer(frame);
        output.writePixels(data.max.y - data.min.y + 1);
    } // which writes the table of lines
    if (!is_whole(bytes)) {
        return error_set(e, ERROR_MEMORY, "'%s' cannot be written: out of memory", file);
    }
    return file_replace(file, bytes.data(), bytes.size(), e);
}

} // namespace

extern "C" bool encode_exr(const char *file, const ImageLayer *layers, int count, const int *window,
                           const char *metadata, Error *e)
{
    return guarded("'" + std::string(file) + "' cannot be written", e,
                   [&] { return write_exr(file, layers, count, window, metadata, e); });
}
