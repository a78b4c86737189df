// The child's side of image/read.c: untrusted picture files are parsed only in a process with
// limits (base/child.h).
#ifndef RAMIFY_IMAGE_DECODE_H
#define RAMIFY_IMAGE_DECODE_H

#include "base/child.h"
#include "image/image.h"

// What to read from a picture.
typedef enum DecodeKind {
    DECODE_ALL,     // every channel, as floats
    DECODE_COLOR,   // see image_read_color
    DECODE_LAYER,   // see image_read_layer
    DECODE_TEXTURE, // see image_read_texels
    DECODE_NAMED,   // see image_read_channels
    DECODE_TEXT,    // no pixels, although all are decoded; see image_read_text
    DECODE_METADATA // no pixels; see image_read_metadata
} DecodeKind;

typedef struct DecodeJob {
    const char *file;
    const unsigned char
        *bytes; // `size` of the file, a PNG, which is then a name alone; NULL = read it
    size_t size;
    DecodeKind kind;
    const char *layer, *channels; // DECODE_LAYER
    const char *const *names;     // DECODE_NAMED: `count` of channels
    int count;
    const char *key; // DECODE_TEXT, DECODE_METADATA
} DecodeJob;

// Limits: pixels (16384 x 8192), and bytes of the requested channels.
enum { DECODE_MAX_PIXELS = 1 << 27 };
#define DECODE_MAX_BYTES (INT64_C(1) << 31)

enum { DECODE_TEXT_SIZE = 1024, DECODE_METADATA_SIZE = 1 << 26 };

// Precedes the pixels, which follow row by row.
typedef struct DecodeHeader {
    int32_t width, height, channels; // of the pixels that follow
    int32_t type;                    // of a channel: a TexelType
    int32_t linear;                  // 1 = the file holds floating-point radiance
    int32_t window[6]; // left and top of the pixels; left, top, width, height of the picture
    char text[DECODE_TEXT_SIZE]; // DECODE_TEXT: the text found
    int32_t metadata; // DECODE_METADATA: bytes of the text, which follow in place of pixels
} DecodeHeader;

// A ChildTask; data: a DecodeJob. Sizes are checked before any pixel is decoded.
bool decode_picture(const void *data, ChildOutput *output, Error *e);

#endif
