// Reads pictures decoded in a child process with limits; checks the child's result.
#include "image/decode.h"

#include "base/memory.h"
#include "image/codec.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define WANTED "a whole picture, as PNG, JPEG, EXR, HDR or TIFF,"

// Limits of decoding: a format decoded as a whole needs all pixels once more beside the result;
// 16384 x 8192 pixels take some ten seconds.
#define MAX_SECONDS 120.0
#define MAX_MEMORY (2 * DECODE_MAX_BYTES + 1000000000)

// A pipe or a device would never end, and OpenImageIO interprets names that are not files.
static bool check_file(const char *file, Error *e)
{
    struct stat status;
    if (!file || !file[0]) {
        return error_set(e, ERROR_INPUT, "no name is given");
    }
    if (stat(file, &status) != 0) {
        return error_set(e, ERROR_INPUT, "%s", strerror(errno));
    }
    return S_ISREG(status.st_mode) ||
           error_set(e, ERROR_INPUT, "it is not a regular file; " WANTED " is needed");
}

static bool check_header(const DecodeHeader *h, const DecodeJob *job, int64_t left, Error *e)
{
    bool sane = h->width >= 1 && h->height >= 1 && h->channels >= 1 && h->channels <= 1024 &&
                h->type >= TEXEL_BYTE && h->type <= TEXEL_FLOAT &&
                (job->kind == DECODE_TEXTURE || h->type == TEXEL_FLOAT) && h->window[4] >= 1 &&
                h->window[5] >= 1 && h->text[DECODE_TEXT_SIZE - 1] == '\0' &&
                (int64_t)h->width * h->height <= DECODE_MAX_PIXELS && h->metadata >= 0 &&
                h->metadata <= DECODE_METADATA_SIZE;
    int64_t bytes =
        sane ? (int64_t)h->width * h->height * h->channels * texel_bytes((TexelType)h->type) : 0;
    bool pixels = job->kind != DECODE_TEXT && job->kind != DECODE_METADATA;
    return (sane && left == (pixels ? bytes : h->metadata)) ||
           error_set(e, ERROR_INPUT, "the reader's result makes no sense; " WANTED " is needed");
}

static bool fail(const DecodeJob *job, Error *e)
{
    if (e) {
        e->file[0] = '\0'; // the message has the name; the location is added by the caller
        e->line = e->column = 0;
        error_prefix(e,
                     "%s '%s' cannot be read: ", job->kind == DECODE_TEXTURE ? "texture" : "image",
                     job->file ? job->file : "");
    }
    return false;
}

// Reads the header; leaves output open at the pixels, to be closed by the caller.
static bool start(const DecodeJob *job, DecodeHeader *header, ChildOutput *output, const Run *run,
                  Error *e)
{
    *output = (ChildOutput){.file = -1};
    const ImageReader *reader = job->bytes || check_file(job->file, e) ? image_reader(e) : NULL;
    if (!reader) {
        return fail(job, e);
    }
    const ChildJob child = {.task = reader->decode,
                            .data = job,
                            .file = job->file,
                            .wanted = WANTED,
                            .seconds = MAX_SECONDS,
                            .memory = MAX_MEMORY};
    const Run alone = run_default();
    bool done = child_run(&child, run ? run : &alone, output, e) &&
                child_read(output, header, 1, sizeof *header, e) &&
                check_header(header, job, output->left, e);
    if (!done) {
        child_output_close(output);
        return fail(job, e);
    }
    return true;
}

static Image *read_floats(const DecodeJob *job, DecodeHeader *h, const Run *run, Error *e)
{
    ChildOutput output;
    if (!start(job, h, &output, run, e)) {
        return NULL;
    }
    Image *image = image_new(h->width, h->height, h->channels, e);
    int64_t count = (int64_t)h->width * h->height * h->channels;
    if (!image || !child_read(&output, image->pixel, count, sizeof *image->pixel, e)) {
        image_free(image);
        image = NULL;
        fail(job, e);
    }
    child_output_close(&output);
    return image;
}

Image *image_read(const char *file, const Run *run, Error *e)
{
    DecodeHeader header;
    return read_floats(&(DecodeJob){.file = file, .kind = DECODE_ALL}, &header, run, e);
}

Image *image_decode_png(const unsigned char *bytes, size_t size, Error *e)
{
    DecodeHeader header;
    return read_floats(
        &(DecodeJob){.file = "memory.png", .bytes = bytes, .size = size, .kind = DECODE_ALL},
        &header, NULL, e);
}

Image *image_read_color(const char *file, bool *linear, const Run *run, Error *e)
{
    DecodeHeader header = {0};
    Image *image = read_floats(&(DecodeJob){.file = file, .kind = DECODE_COLOR}, &header, run, e);
    *linear = header.linear != 0;
    return image;
}

Image *image_read_layer(const char *file, const char *layer, const char *channels, const Run *run,
                        Error *e)
{
    DecodeHeader header;
    return read_floats(
        &(DecodeJob){.file = file, .kind = DECODE_LAYER, .layer = layer, .channels = channels},
        &header, run, e);
}

Image *image_read_channels(const char *file, const char *const *names, int count, int window[6],
                           const Run *run, Error *e)
{
    DecodeHeader header = {0};
    Image *image = read_floats(
        &(DecodeJob){.file = file, .kind = DECODE_NAMED, .names = names, .count = count}, &header,
        run, e);
    memcpy(window, header.window, sizeof header.window);
    return image;
}

char *image_read_metadata(const char *file, const char *key, const Run *run, Error *e)
{
    const DecodeJob job = {.file = file, .kind = DECODE_METADATA, .key = key};
    ChildOutput output;
    DecodeHeader h;
    if (!start(&job, &h, &output, run, e)) {
        return NULL;
    }
    char *text = memory_alloc_zero((int64_t)h.metadata + 1, 1, e);
    if (text && !child_read(&output, text, h.metadata, 1, e)) {
        free(text);
        text = NULL;
        fail(&job, e);
    }
    child_output_close(&output);
    return text;
}

bool image_read_text(const char *file, const char *key, char *text, int size)
{
    const DecodeJob job = {.file = file, .kind = DECODE_TEXT, .key = key};
    ChildOutput output;
    DecodeHeader h;
    if (!start(&job, &h, &output, NULL, NULL)) {
        return false;
    }
    child_output_close(&output);
    snprintf(text, (size_t)size, "%s", h.text);
    return h.text[0] != '\0';
}

Texels *image_read_texels(const char *file, const Run *run, Error *e)
{
    const DecodeJob job = {.file = file, .kind = DECODE_TEXTURE};
    ChildOutput output;
    DecodeHeader h;
    if (!start(&job, &h, &output, run, e)) {
        return NULL;
    }
    int64_t count = (int64_t)h.width * h.height * h.channels;
    int bytes = texel_bytes((TexelType)h.type);
    Texels *texels = memory_alloc(1, sizeof *texels, e);
    void *data = texels ? memory_alloc(count, (size_t)bytes, e) : NULL;
    if (!data || !child_read(&output, data, count, (size_t)bytes, e)) {
        free(texels);
        free(data);
        texels = NULL;
        fail(&job, e);
    } else {
        *texels = (Texels){.width = h.width,
                           .height = h.height,
                           .channels = h.channels,
                           .type = (TexelType)h.type,
                           .data = data};
        memcpy(texels->window, h.window, sizeof texels->window);
    }
    child_output_close(&output);
    return texels;
}
