// EXR files by OpenEXR, in the plug-in ramify-write.so.
#ifndef RAMIFY_IMAGE_ENCODE_EXR_H
#define RAMIFY_IMAGE_ENCODE_EXR_H

#include "image/encode.h"
#include "image/encoded.h"

// Appends a whole file of the job's layers, and decodes it again: it has these pixels, or there is
// an error: ERROR_INPUT, ERROR_MEMORY, ERROR_INTERNAL.
bool encode_exr(const EncodeJob *job, Encoded *file, Error *e);

#endif
