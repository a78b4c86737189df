// Denoising by Intel's Open Image Denoise, versions 1 and 2. Its library is loaded when it is
// needed and is no dependency of the build.
#ifndef RAMIFY_IMAGE_OIDN_H
#define RAMIFY_IMAGE_OIDN_H

#include "base/run.h"
#include "image/image.h"

// Environment variable that names the library to load in place of those in the loader's path.
#define OIDN_VARIABLE "RAMIFY_OIDN"

// Version of the library, e.g. 20501 for 2.5.1; 0 and ERROR_INPUT when no usable one can be loaded.
int image_oidn_version(Error *e);

// Filters linear radiance, guided by albedo and normal. All images have the same size; color has 3
// or 4 channels (alpha is kept), albedo and normal 3. Uses run->threads threads of the processor
// (one thread more or less may change the last bits) and ends early when run is cancelled.
// ERROR_INPUT as from image_oidn_version and when sizes or channels do not match, ERROR_CANCELLED,
// ERROR_MEMORY, ERROR_INTERNAL with the library's message. The caller frees the image.
Image *image_denoise_oidn(const Image *color, const Image *albedo, const Image *normal,
                          const Run *run, Error *e);

#endif
