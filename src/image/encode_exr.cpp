// Writes EXR pictures by OpenEXR: planes are read where they lie.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

extern "C" {
#include "image/encode_exr.h"
}

namespace
{

const int ROWS_AT_A_TIME = 64;

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
    explicit ExrOutput(Encoded *encoded) : OStream("memory.exr"), file(encoded)
    {
    }
    void write(const char source[], int count) override
    {
        int64_t end = at + count;
        if (end > file->size) {
            if (!encoded_reserve(file, size_t(end - file->size), nullptr)) {
                throw std::bad_alloc();
            }
            std::memset(file->bytes + file->size, 0, size_t(end - file->size));
            file->size = end;
        }
        std::memcpy(file->bytes + at, source, size_t(count));
        at = end;
    }
    uint64_t tellp() override
    {
        return uint64_t(at);
    }
    void seekp(uint64_t to) override
    {
        at = int64_t(to);
    }

  private:
    Encoded *file;
    int64_t at = 0;
};

// An EXR file in memory, for OpenEXR to look into.
class ExrInput : public Imf::IStream
{
  public:
    explicit ExrInput(const Encoded *encoded) : IStream("memory.exr"), file(encoded)
    {
    }
    bool read(char target[], int count) override
    {
        if (count < 0 || count > file->size - at) {
            throw std::runtime_error("the end is missing");
        }
        std::memcpy(target, file->bytes + at, size_t(count));
        at += count;
        return at < file->size;
    }
    uint64_t tellg() override
    {
        return uint64_t(at);
    }
    void seekg(uint64_t to) override
    {
        at = std::min(int64_t(to), file->size);
    }

  private:
    const Encoded *file;
    int64_t at = 0;
};

bool check_layers(const ImageLayer *layers, int count, Error *e)
{
    for (int i = 0; i < count; i++) {
        const Image *image = layers[i].image, *first = layers[0].image;
        if (image->width != first->width || image->height != first->height) {
            return error_set(e, ERROR_INPUT, "layer '%s' is %d x %d, the first one %d x %d",
                             layers[i].name, image->width, image->height, first->width,
                             first->height);
        }
        if ((int)std::strlen(layers[i].channel_names) != image->channels) {
            return error_set(e, ERROR_INPUT, "layer '%s' has %d channels but the names '%s'",
                             layers[i].name, image->channels, layers[i].channel_names);
        }
    }
    return count > 0 || error_set(e, ERROR_INPUT, "no layers");
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

// The name of a layer's channel in the file.
std::string channel_name(const ImageLayer &layer, int c)
{
    return (layer.name[0] ? std::string(layer.name) + "." : "") + layer.channel_names[c];
}

// Adds the layers' channels, which stay where they are.
void add_channels(const EncodeJob &job, Imf::Header &header, Imf::FrameBuffer &frame)
{
    for (int i = 0; i < job.count; i++) {
        const Image *image = job.layers[i].image;
        size_t pixel = sizeof(float) * size_t(image->channels), row = pixel * size_t(image->width);
        for (int c = 0; c < image->channels; c++) {
            std::string name = channel_name(job.layers[i], c);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice(Imf::FLOAT, (char *)(image->pixel + c), pixel, row));
        }
    }
}

void write_lines(const EncodeJob &job, Encoded *file)
{
    Imf::Header header = make_header(job.layers[0].image, job.window, job.metadata);
    Imf::FrameBuffer frame;
    add_channels(job, header, frame);
    const Imath::Box2i &data = header.dataWindow();
    ExrOutput stream(file);
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(frame);
    output.writePixels(data.max.y - data.min.y + 1);
} // its destructor writes the table of lines

// Rows of all channels as they are read back, one plane a channel.
struct Planes {
    size_t width;
    std::vector<float> value;

    float *row(size_t plane, int y)
    {
        return value.data() + (plane * size_t(ROWS_AT_A_TIME) + size_t(y)) * width;
    }
};

// first: the row of the picture that is the planes' first one.
bool same_rows(const EncodeJob &job, Planes &planes, int left, int first, int rows)
{
    size_t plane = 0;
    for (int i = 0; i < job.count; i++) {
        const Image *image = job.layers[i].image;
        for (int c = 0; c < image->channels; c++, plane++) {
            for (int y = 0; y < rows; y++) {
                const float *wanted = image->pixel +
                                      ((size_t)(first + y) * size_t(image->width) + size_t(left)) *
                                          size_t(image->channels) +
                                      c;
                const float *found = planes.row(plane, y);
                for (size_t x = 0; x < planes.width; x++, wanted += image->channels) {
                    if (std::memcmp(wanted, found + x, sizeof(float)) != 0) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

// Lines of pixels that could not be written for lack of memory are no error to OpenEXR: they are
// left out. So all are read again and compared bit by bit, some at a time.
bool holds_all(const EncodeJob &job, const Encoded *file)
{
    ExrInput stream(file);
    Imf::InputFile input(stream);
    const Imath::Box2i &data = input.header().dataWindow();
    size_t channels = 0;
    for (int i = 0; i < job.count; i++) {
        channels += size_t(job.layers[i].image->channels);
    }
    Planes planes = {size_t(data.max.x - data.min.x + 1), {}};
    planes.value.resize(channels * size_t(ROWS_AT_A_TIME) * planes.width);
    bool same = input.isComplete();
    for (int y = data.min.y; same && y <= data.max.y; y += ROWS_AT_A_TIME) {
        int last = std::min(y + ROWS_AT_A_TIME - 1, data.max.y);
        Imf::FrameBuffer frame;
        size_t plane = 0;
        for (int i = 0; i < job.count; i++) {
            for (int c = 0; c < job.layers[i].image->channels; c++, plane++) {
                // OpenEXR counts from the picture's corner
                char *corner = (char *)planes.row(plane, 0) -
                               (ptrdiff_t(y) * ptrdiff_t(planes.width) + data.min.x) *
                                   ptrdiff_t(sizeof(float));
                frame.insert(
                    channel_name(job.layers[i], c),
                    Imf::Slice(Imf::FLOAT, corner, sizeof(float), sizeof(float) * planes.width));
            }
        }
        input.setFrameBuffer(frame);
        input.readPixels(y, last);
        same = same_rows(job, planes, data.min.x, y, last - y + 1);
    }
    return same;
}

} // namespace

extern "C" bool encode_exr(const EncodeJob *job, Encoded *file, Error *e)
{
    if (!check_layers(job->layers, job->count, e)) {
        return false;
    }
    try {
        ExrThreads threads;
        write_lines(*job, file);
        return holds_all(*job, file) ||
               error_set(e, ERROR_MEMORY, "what was written is not complete; out of memory");
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "out of memory");
    } catch (const std::exception &failure) {
        return error_set(e, ERROR_INTERNAL, "%s", failure.what());
    } catch (...) {
        return error_set(e, ERROR_INTERNAL, "its writer failed for no known reason");
    }
}
