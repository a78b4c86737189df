// JPEG files by libjpeg, in the plug-in ramify-write.so.
#ifndef RAMIFY_IMAGE_ENCODE_JPEG_H
#define RAMIFY_IMAGE_ENCODE_JPEG_H

#include "image/encoded.h"
#include "image/raster.h"

// Appends a whole file of a raster with three channels of one byte, without subsampling, the
// metadata as "key: value" lines of its comment, cut where a comment must end. Decodes it again: it
// has these pixels, but for what compression does, and a comment, or there is an error. Equal
// rasters give equal files. ERROR_MEMORY, ERROR_INTERNAL.
bool encode_jpeg(const Raster *raster, Encoded *file, Error *e);

#endif
