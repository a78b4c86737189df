// EXR pictures, in the plug-in ramify-oiio.so.
#ifndef RAMIFY_IMAGE_ENCODE_EXR_H
#define RAMIFY_IMAGE_ENCODE_EXR_H

#ifdef __cplusplus
extern "C" {
#endif

#include "image/image.h"

// See image_write_exr_window; window NULL = all of the picture.
bool encode_exr(const char *file, const ImageLayer *layers, int count, const int *window,
                const char *metadata, Error *e);

#ifdef __cplusplus
}
#endif

#endif
