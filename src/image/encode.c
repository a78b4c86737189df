// Lays pictures out for their formats.
#include "image/encode.h"

#include "base/memory.h"
#include "image/codec.h"
#include "image/encode_exr.h"
#include "image/encode_jpeg.h"
#include "image/encode_png.h"
#include "image/quantise.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool has_extension(const char *file, const char *extension)
{
    const char *dot = strrchr(file, '.');
    return dot && !strchr(dot, '/') && strcasecmp(dot + 1, extension) == 0;
}

static bool is_jpeg(const char *file)
{
    return has_extension(file, "jpg") || has_extension(file, "jpeg");
}

// 8 bits; without_alpha: composited over black. The caller frees it.
static uint8_t *quantise_8(const Image *image, bool without_alpha, Error *e)
{
    int channels = without_alpha ? 3 : image->channels;
    uint8_t *bytes = memory_alloc((int64_t)image->width * image->height * channels, 1, e);
    uint8_t *out = bytes;
    for (int y = 0; bytes && y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            const float *p = image->pixel + ((size_t)y * (size_t)image->width + (size_t)x) *
                                                (size_t)image->channels;
            float over = without_alpha && image->channels == 4 ? p[3] : 1.0f;
            for (int c = 0; c < channels; c++) {
                *out++ = c == 3 ? quantise_nearest(p[c]) : quantise_dithered(p[c] * over, x, y, c);
            }
        }
    }
    return bytes;
}

// All channels; the caller frees it.
static uint16_t *quantise_16(const Image *image, Error *e)
{
    int64_t count = (int64_t)image->width * image->height * image->channels;
    uint16_t *shorts = memory_alloc(count, sizeof *shorts, e);
    for (int64_t i = 0; shorts && i < count; i++) {
        float value = image->pixel[i];
        float v = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f; // NaN becomes 0
        shorts[i] = (uint16_t)(v * 65535.0f + 0.5f);
    }
    return shorts;
}

static bool check_channels(const Image *image, Error *e)
{
    return image->channels == 3 || image->channels == 4 ||
           error_set(e, ERROR_INPUT, "%d channels; 3 or 4 would do", image->channels);
}

static Raster raster_of(const EncodeJob *job, const void *samples)
{
    return (Raster){.width = job->image->width,
                    .height = job->image->height,
                    .channels = job->image->channels,
                    .sample_bytes = 1,
                    .samples = samples,
                    .metadata = job->metadata};
}

// A PNG or JPEG, by the file name's extension.
static bool encode_display(const EncodeJob *job, Encoded *file, Error *e)
{
    bool jpeg = is_jpeg(job->file);
    if (!jpeg && !has_extension(job->file, "png")) {
        return error_set(e, ERROR_INPUT, "the name must end in .png, .jpg or .jpeg");
    }
    uint8_t *bytes = check_channels(job->image, e) ? quantise_8(job->image, jpeg, e) : NULL;
    if (!bytes) {
        return false;
    }
    Raster raster = raster_of(job, bytes);
    raster.channels = jpeg ? 3 : raster.channels;
    bool done = jpeg ? encode_jpeg(&raster, file, e) : encode_png(&raster, file, e);
    free(bytes);
    return done;
}

static bool encode_png16(const EncodeJob *job, bool linear, Encoded *file, Error *e)
{
    uint16_t *shorts = quantise_16(job->image, e);
    Raster raster = raster_of(job, shorts);
    raster.sample_bytes = 2;
    raster.linear = linear;
    bool done = shorts && encode_png(&raster, file, e);
    free(shorts);
    return done;
}

static bool encode_display16(const EncodeJob *job, Encoded *file, Error *e)
{
    if (!has_extension(job->file, "png")) {
        return error_set(e, ERROR_INPUT, "a picture of 16 bits must be named .png");
    }
    return check_channels(job->image, e) && encode_png16(job, false, file, e);
}

static bool encode_grey16(const EncodeJob *job, Encoded *file, Error *e)
{
    if (!has_extension(job->file, "png") || job->image->channels != 1) {
        return error_set(e, ERROR_INPUT,
                         "a 16-bit grey picture has one channel and a name that ends in .png");
    }
    return encode_png16(job, true, file, e); // linear: no viewer applies a curve to heights
}

static bool encode_kind(const EncodeJob *job, Encoded *file, Error *e)
{
    switch (job->kind) {
    case ENCODE_DISPLAY16:
        return encode_display16(job, file, e);
    case ENCODE_GREY16:
        return encode_grey16(job, file, e);
    case ENCODE_EXR:
        return encode_exr(job, file, e);
    default:
        return encode_display(job, file, e);
    }
}

static bool encode_picture(const void *data, ChildOutput *output, Error *e)
{
    Encoded file = {0};
    bool done = encode_kind(data, &file, e) && child_write(output, file.bytes, file.size, 1, e);
    encoded_clear(&file);
    return done;
}

extern const ImageWriter image_writer_write;
const ImageWriter image_writer_write = {sizeof(ImageWriter), encode_picture};
