// Reads pictures of any format through OpenImageIO and writes PNG, JPEG and EXR. Files are read in
// a child process with limits (base/child.h): 2^27 pixels (16384 x 8192) and 2 GB of the requested
// channels, checked before any pixel is decoded; ERROR_INPUT names the file, its size and the
// limit. Files are written to a temporary name and renamed: a failure leaves no partial file and an
// old one unchanged.
#ifndef RAMIFY_IMAGE_IMAGE_H
#define RAMIFY_IMAGE_IMAGE_H

#include "base/error.h"
#include "base/run.h"

#include <stddef.h>
#include <stdint.h>

// Reading stops with ERROR_CANCELLED when its run is cancelled; run NULL = it cannot be.

// Loads what writes pictures (base/plugin.h), which the first function that writes would do:
// whether it can is better known before an image is made than after. Errors: see plugin_table.
bool image_files_check(Error *e);

// width * height * channels floats, row by row from the top left.
typedef struct Image {
    int width, height, channels;
    float *pixel;
} Image;

Image *image_new(int width, int height, int channels, Error *e);
void image_free(Image *image); // NULL is fine

// Reads any format of OpenImageIO as stored values (8-bit: 0..1, not linearised).
Image *image_read(const char *file, const Run *run, Error *e);

// Reads R, G, B and, if present, A, as stored; grey as three equal channels. *linear: whether the
// file holds floating-point radiance (EXR, HDR; alpha premultiplied) or display values (alpha
// straight). Other channels are ignored.
Image *image_read_color(const char *file, bool *linear, const Run *run, Error *e);

// Reads channels of one layer of a file, in the order named, as written by image_write_exr: layer
// "variance" and channels "RGB" are variance.R, variance.G, variance.B. ERROR_INPUT when one is
// missing.
Image *image_read_layer(const char *file, const char *layer, const char *channels, const Run *run,
                        Error *e);

// Reads these channels, in this order, by their full names ("variance.V"). window: left and top of
// the pixels; left, top, width and height of the whole picture.
Image *image_read_channels(const char *file, const char *const *names, int count, int window[6],
                           const Run *run, Error *e);

// The metadata text under key, up to 64 MB, without decoding a pixel; the caller frees it.
// ERROR_INPUT when there is none.
char *image_read_metadata(const char *file, const char *key, const Run *run, Error *e);

// A picture in its stored type, for random access.
typedef enum TexelType { TEXEL_BYTE, TEXEL_SHORT, TEXEL_HALF, TEXEL_FLOAT } TexelType;

static inline int texel_bytes(TexelType type)
{
    return type == TEXEL_BYTE ? 1 : type == TEXEL_FLOAT ? 4 : 2;
}

// width * height * channels values of type, row by row from the top left; colours are multiplied by
// alpha.
typedef struct Texels {
    int width, height, channels;
    TexelType type; // the file's, or TEXEL_FLOAT for other types
    int window[6];  // left and top of the pixels; left, top, width and height of the whole picture
    void *data;
} Texels;

// Reads any format of OpenImageIO.
Texels *image_read_texels(const char *file, const Run *run, Error *e);
void texels_free(Texels *texels); // NULL is fine

// Decodes the whole picture to check that it is complete, and copies the metadata text stored under
// key into text (size bytes, truncated if needed). False if the picture is incomplete or has no
// such text.
bool image_read_text(const char *file, const char *key, char *text, int size);

// Writes an 8-bit PNG or JPEG (by the name's extension) of an image in display values; 3 or 4
// channels, 0..1, alpha straight; JPEG is composited over black. Dithered by a fixed pattern.
// metadata: "key\0value\0...\0\0" pairs or NULL.
bool image_write_display(const char *file, const Image *image, const char *metadata, Error *e);

// The same as a PNG of 16 bits, rounded to the nearest; the name must end in .png.
bool image_write_display16(const char *file, const Image *image, const char *metadata, Error *e);

// The same PNG in memory: *bytes (free() it) of *size; and the inverse, as stored values.
bool image_encode_png(const Image *image, const char *metadata, unsigned char **bytes, size_t *size,
                      Error *e);
Image *image_decode_png(const unsigned char *bytes, size_t size, Error *e);

// Writes a 16-bit grey PNG of an image with one channel, 0..1.
bool image_write_grey16(const char *file, const Image *image, const char *metadata, Error *e);

// One layer of a multi-part or multi-channel EXR.
typedef struct ImageLayer {
    const char *name;          // "" = the beauty: R, G, B(, A); else channels name.X ...
    const char *channel_names; // e.g. "RGBA", "XYZ", "Z"
    const Image *image;
} ImageLayer;

// Writes a linear float EXR with all layers (of one size) and metadata.
bool image_write_exr(const char *file, const ImageLayer *layers, int count, const char *metadata,
                     Error *e);

// The same of a part of the picture: left, top, width and height of the pixels that are written, as
// OpenEXR's data window in the display window of the whole.
bool image_write_exr_window(const char *file, const ImageLayer *layers, int count,
                            const int window[4], const char *metadata, Error *e);

#endif
