// EXR pictures, in the plug-in ramify-oiio.so. C++.
#ifndef RAMIFY_IMAGE_ENCODE_EXR_H
#define RAMIFY_IMAGE_ENCODE_EXR_H

#include <vector>

extern "C" {
#include "image/encode.h"
}

// Encodes the layers and decodes the result again: bytes are a whole file with these pixels, or
// there is an error. Throws.
bool encode_exr(const EncodeJob &job, std::vector<unsigned char> &bytes, Error *e);

#endif
