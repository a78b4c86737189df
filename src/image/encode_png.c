// PNG Specification (Second Edition). libpng returns from an error by longjmp, to the function that
// called it: those functions change no variable of their own after setjmp.
#include "image/encode_png.h"

#include "base/memory.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

static void fail(png_structp png, const char *message)
{
    bool memory = strcasestr(message, "memory") != NULL; // "Insufficient memory" and others
    error_set(png_get_error_ptr(png), memory ? ERROR_MEMORY : ERROR_INTERNAL, "%s",
              memory ? "out of memory" : message);
    png_longjmp(png, 1);
}

static void ignore(png_structp png, const char *message)
{
    (void)png;
    (void)message;
}

// ---- writing

static void append(png_structp png, png_bytep bytes, size_t size)
{
    if (!encoded_append(png_get_io_ptr(png), bytes, size, NULL)) {
        png_error(png, "out of memory");
    }
}

static void flush(png_structp png)
{
    (void)png;
}

// A tEXt chunk. libpng's own way would copy all texts.
static void write_text(png_structp png, const char *key, const char *value)
{
    size_t name = strlen(key) + 1, length = strlen(value);
    png_write_chunk_start(png, (png_const_bytep) "tEXt", (png_uint_32)(name + length));
    png_write_chunk_data(png, (png_const_bytep)key, name);
    png_write_chunk_data(png, (png_const_bytep)value, length);
    png_write_chunk_end(png);
}

static void write_texts(png_structp png, const char *metadata)
{
    write_text(png, "Software", "ramify");
    for (const char *key = metadata; key && *key;) {
        const char *value = key + strlen(key) + 1;
        write_text(png, key, value);
        key = value + strlen(value) + 1;
    }
}

static int color_type(int channels)
{
    return channels == 1   ? PNG_COLOR_TYPE_GRAY
           : channels == 3 ? PNG_COLOR_TYPE_RGB
                           : PNG_COLOR_TYPE_RGB_ALPHA;
}

static bool write_all(png_structp png, png_infop info, const Raster *raster)
{
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    png_set_IHDR(png, info, (png_uint_32)raster->width, (png_uint_32)raster->height,
                 8 * raster->sample_bytes, color_type(raster->channels), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (raster->linear) {
        png_set_gAMA(png, info, 1.0);
    } else {
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    }
    png_write_info(png, info);
    write_texts(png, raster->metadata);
    if (raster->sample_bytes == 2) {
        png_set_swap(png); // PNG has the high byte first
    }
    for (int y = 0; y < raster->height; y++) {
        png_write_row(png, raster_row(raster, y));
    }
    png_write_end(png, NULL);
    return true;
}

static bool write_file(const Raster *raster, Encoded *file, Error *e)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, e, fail, ignore);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool done = false;
    if (info) {
        png_set_write_fn(png, file, append, flush);
        done = write_all(png, info, raster);
    } else {
        error_set(e, ERROR_MEMORY, "out of memory");
    }
    png_destroy_write_struct(&png, &info);
    return done;
}

// ---- reading it again

typedef struct Source {
    const Encoded *file;
    int64_t at; // bytes read
} Source;

static void take(png_structp png, png_bytep bytes, size_t size)
{
    Source *source = png_get_io_ptr(png);
    if ((int64_t)size > source->file->size - source->at) {
        png_error(png, "its end is missing");
    }
    memcpy(bytes, source->file->bytes + source->at, size);
    source->at += (int64_t)size;
}

static int count_texts(const char *metadata)
{
    int count = 1; // Software
    for (const char *key = metadata; key && *key; count++) {
        key += strlen(key) + 1;
        key += strlen(key) + 1;
    }
    return count;
}

// row: memory for one row.
static bool is_same(png_structp png, png_infop info, const Raster *raster, unsigned char *row)
{
    if (setjmp(png_jmpbuf(png))) {
        return false;
    }
    png_set_chunk_cache_max(png, 0); // no limits: the texts are our own
    png_set_chunk_malloc_max(png, 0);
    png_read_info(png, info);
    png_textp texts;
    if (png_get_image_width(png, info) != (png_uint_32)raster->width ||
        png_get_image_height(png, info) != (png_uint_32)raster->height ||
        png_get_channels(png, info) != raster->channels ||
        png_get_bit_depth(png, info) != 8 * raster->sample_bytes ||
        png_get_text(png, info, &texts, NULL) != count_texts(raster->metadata)) {
        return false;
    }
    if (raster->sample_bytes == 2) {
        png_set_swap(png);
    }
    for (int y = 0; y < raster->height; y++) {
        png_read_row(png, row, NULL);
        if (memcmp(row, raster_row(raster, y), raster_row_bytes(raster)) != 0) {
            return false;
        }
    }
    png_read_end(png, NULL);
    return true;
}

static bool check_file(const Raster *raster, const Encoded *file, Error *e)
{
    Source source = {.file = file};
    unsigned char *row = memory_alloc((int64_t)raster_row_bytes(raster), 1, NULL);
    png_structp png =
        row ? png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, fail, ignore) : NULL;
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool done = false;
    if (info) {
        png_set_read_fn(png, &source, take);
        done = is_same(png, info, raster, row);
    }
    png_destroy_read_struct(&png, &info, NULL);
    free(row);
    return done || error_set(e, ERROR_MEMORY, "what was written is not complete; out of memory");
}

bool encode_png(const Raster *raster, Encoded *file, Error *e)
{
    return write_file(raster, file, e) && check_file(raster, file, e);
}
