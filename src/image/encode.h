// What image/write.c has a child process encode: the libraries for it may crash, wait for ever or
// leave lines out when memory runs out.
#ifndef RAMIFY_IMAGE_ENCODE_H
#define RAMIFY_IMAGE_ENCODE_H

#include "base/child.h"
#include "image/image.h"

// As what to encode a picture: see the functions of image.h.
typedef enum EncodeKind {
    ENCODE_DISPLAY,   // image_write_display
    ENCODE_DISPLAY16, // image_write_display16
    ENCODE_GREY16,    // image_write_grey16
    ENCODE_EXR        // image_write_exr_window
} EncodeKind;

typedef struct EncodeJob {
    EncodeKind kind;
    const char *file;         // its extension tells the format
    const Image *image;       // all but ENCODE_EXR
    const ImageLayer *layers; // ENCODE_EXR: `count` of them
    int count;
    const int *window; // ENCODE_EXR: left, top, width and height; NULL = all
    const char *metadata;
} EncodeJob;

#endif
