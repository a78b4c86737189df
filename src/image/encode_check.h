// Whether an encoded PNG or JPEG holds what it was made of. C++.
#ifndef RAMIFY_IMAGE_ENCODE_CHECK_H
#define RAMIFY_IMAGE_ENCODE_CHECK_H

#include "image/encode_bytes.h"

// Decodes the bytes and compares size, channels, pixels (bit by bit; JPEG: each row on the average)
// and the metadata's keys: out of memory, OpenImageIO and its libraries leave out attributes
// without an error. False = something is missing or other. Throws.
bool encoded_well(const Encoding &job, const Bytes &bytes);

#endif
