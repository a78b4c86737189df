// The child's side of reading pictures (image/read.c): all that other people's picture files are
// parsed by runs in a process with limits (base/child.h).
#ifndef RAMIFY_IMAGE_DECODE_H
#define RAMIFY_IMAGE_DECODE_H

#include "base/child.h"
#include "image/image.h"

// What is wanted of a picture.
typedef enum DecodeKind {
    DECODE_ALL,     // every channel, as floats
    DECODE_COLOR,   // as image_read_color says
    DECODE_LAYER,   // as image_read_layer says
    DECODE_TEXTURE, // as image_read_texels says
    DECODE_TEXT     // no pixels, but all looked at; as image_read_text says
} DecodeKind;

typedef struct DecodeJob {
    const char *file;
    DecodeKind kind;
    const char *layer, *channels; // DECODE_LAYER
    const char *key;              // DECODE_TEXT
} DecodeJob;

// At most so many pixels (16384 x 8192), and so many bytes of those channels that are wanted.
enum { DECODE_MOST_PIXELS = 1 << 27 };
#define DECODE_MOST_BYTES (INT64_C(1) << 31)

enum { DECODE_TEXT_SIZE = 1024 };

// Goes before the pixels, which follow row by row.
typedef struct DecodeHeader {
    int32_t width, height, channels; // of the pixels that follow
    int32_t type;                    // of a channel: a TexelType
    int32_t linear;                  // 1 = the file holds floating-point radiance
    int32_t window[6]; // the left top of the pixels; left, top, width, height of the picture
    char text[DECODE_TEXT_SIZE]; // DECODE_TEXT: what was found
} DecodeHeader;

// A ChildTask on a DecodeJob. Sizes are checked before any pixel is decoded.
bool decode_picture(const void *data, ChildOutput *output, Error *e);

#endif
