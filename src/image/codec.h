// The part of the plug-in ramify-oiio.so that reads and writes pictures through OpenImageIO, as a
// table of functions. For the modules of image/ alone; image.h tells what each function does.
#ifndef RAMIFY_IMAGE_CODEC_H
#define RAMIFY_IMAGE_CODEC_H

#include "base/child.h"
#include "image/image.h"

#define OIIO_PLUGIN "oiio" // see plugin_table
#define IMAGE_CODEC "image_codec_oiio"

typedef struct ImageCodec {
    size_t size;       // of this struct
    ChildTask *decode; // of a DecodeJob (image/decode.h)
    ChildTask *encode; // of an EncodeJob (image/encode.h)
} ImageCodec;

// Errors: see plugin_table.
const ImageCodec *image_codec(Error *e);

#endif
