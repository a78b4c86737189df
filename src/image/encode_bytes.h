// Encodes a PNG or JPEG in memory by OpenImageIO. C++.
#ifndef RAMIFY_IMAGE_ENCODE_BYTES_H
#define RAMIFY_IMAGE_ENCODE_BYTES_H

#include <OpenImageIO/imageio.h>

#include <vector>

extern "C" {
#include "base/error.h"
}

using Bytes = std::vector<unsigned char>;

// A picture and what it is to become. All pointers are the caller's.
struct Encoding {
    const char *format; // of OpenImageIO: "png", "jpeg"
    const OIIO::ImageSpec &spec;
    const void *pixels;   // of the spec's window, all channels
    const char *metadata; // "key\0value\0...\0\0" pairs or NULL; a JPEG has them in spec
};

// Encodes and decodes the result again: bytes are a whole file with these pixels and this metadata,
// or there is an error: ERROR_MEMORY, ERROR_INTERNAL. Throws.
bool encode(const Encoding &job, Bytes &bytes, Error *e);

#endif
