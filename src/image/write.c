// Writes pictures that are encoded in a child process.
#include "image/encode.h"

#include "base/file_replace.h"
#include "base/memory.h"
#include "image/codec.h"

#include <stdlib.h>

// Far more than it takes: a limit for a library that waits for itself.
#define LEAST_SECONDS 60.0
#define VALUES_A_SECOND 1e5

static double seconds_for(const EncodeJob *job)
{
    double values = job->image ? (double)job->image->width * job->image->height * 4.0 : 0.0;
    for (int i = 0; i < job->count; i++) {
        const Image *image = job->layers[i].image;
        values += (double)image->width * image->height * image->channels;
    }
    return LEAST_SECONDS + values / VALUES_A_SECOND;
}

static bool run(const ChildJob *child, ChildOutput *output, Error *e)
{
    const Run alone = run_default();
    // Without a process for it, it is done in this one: a rendering of hours is not lost for that.
    return child_run(child, &alone, output, e) ||
           (output->not_started && child_run_here(child, output, e));
}

// The encoded file: *bytes (free() it) of *size.
static bool encode(const EncodeJob *job, unsigned char **bytes, size_t *size, Error *e)
{
    const ImageWriter *writer = image_writer(e);
    if (!writer) {
        return false;
    }
    const ChildJob child = {.task = writer->encode,
                            .data = job,
                            .worker = "writer",
                            .wanted = "a smaller picture or more memory",
                            .seconds = seconds_for(job),
                            .memory = INT64_MAX};
    ChildOutput output;
    if (!run(&child, &output, e)) {
        return false;
    }
    *size = (size_t)output.left;
    *bytes = memory_alloc(output.left, 1, e);
    bool done = *bytes && child_read(&output, *bytes, output.left, 1, e);
    child_output_close(&output);
    if (!done) {
        free(*bytes);
        *bytes = NULL;
    }
    return done;
}

static bool write(const EncodeJob *job, Error *e)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    if (!encode(job, &bytes, &size, e)) {
        error_prefix(e, "'%s' cannot be written: ", job->file);
        return false;
    }
    bool done = file_replace(job->file, bytes, size, e);
    free(bytes);
    return done;
}

bool image_write_display(const char *file, const Image *image, const char *metadata, Error *e)
{
    return write(
        &(EncodeJob){.kind = ENCODE_DISPLAY, .file = file, .image = image, .metadata = metadata},
        e);
}

bool image_write_display16(const char *file, const Image *image, const char *metadata, Error *e)
{
    return write(
        &(EncodeJob){.kind = ENCODE_DISPLAY16, .file = file, .image = image, .metadata = metadata},
        e);
}

bool image_write_grey16(const char *file, const Image *image, const char *metadata, Error *e)
{
    return write(
        &(EncodeJob){.kind = ENCODE_GREY16, .file = file, .image = image, .metadata = metadata}, e);
}

bool image_write_exr(const char *file, const ImageLayer *layers, int count, const char *metadata,
                     Error *e)
{
    return image_write_exr_window(file, layers, count, NULL, metadata, e);
}

bool image_write_exr_window(const char *file, const ImageLayer *layers, int count,
                            const int window[4], const char *metadata, Error *e)
{
    return write(&(EncodeJob){.kind = ENCODE_EXR,
                              .file = file,
                              .layers = layers,
                              .count = count,
                              .window = window,
                              .metadata = metadata},
                 e);
}

bool image_encode_png(const Image *image, const char *metadata, unsigned char **bytes, size_t *size,
                      Error *e)
{
    const EncodeJob job = {
        .kind = ENCODE_DISPLAY, .file = "memory.png", .image = image, .metadata = metadata};
    if (!encode(&job, bytes, size, e)) {
        error_prefix(e, "a picture cannot be made a PNG: ");
        return false;
    }
    return true;
}
