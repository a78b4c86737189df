// The tables of the plug-ins that read and write pictures. For the modules of image/ alone; image.h
// tells what they are for.
#ifndef RAMIFY_IMAGE_CODEC_H
#define RAMIFY_IMAGE_CODEC_H

#include "base/child.h"

// ramify-oiio.so reads any format of OpenImageIO.
typedef struct ImageReader {
    size_t size;       // of this struct
    ChildTask *decode; // of a DecodeJob (image/decode.h)
} ImageReader;

// ramify-write.so writes PNG, JPEG and EXR by their own libraries, which load in a hundredth of the
// time of OpenImageIO: most runs write a picture and read none.
typedef struct ImageWriter {
    size_t size;       // of this struct
    ChildTask *encode; // of an EncodeJob (image/encode.h). The result is a whole file, which has
                       // been decoded again and compared with the picture.
} ImageWriter;

// Errors: see plugin_table.
const ImageReader *image_reader(Error *e);
const ImageWriter *image_writer(Error *e);

#endif
