// PNG files by libpng, in the plug-in ramify-write.so.
#ifndef RAMIFY_IMAGE_ENCODE_PNG_H
#define RAMIFY_IMAGE_ENCODE_PNG_H

#include "image/encoded.h"
#include "image/raster.h"

// Appends a whole file, and decodes it again: it has these pixels and these texts, or there is an
// error. Equal rasters give equal files. ERROR_MEMORY, ERROR_INTERNAL.
bool encode_png(const Raster *raster, Encoded *file, Error *e);

#endif
