// The bytes of a file that is being encoded.
#ifndef RAMIFY_IMAGE_ENCODED_H
#define RAMIFY_IMAGE_ENCODED_H

#include "base/error.h"

#include <stddef.h>
#include <stdint.h>

// All 0 at first.
typedef struct Encoded {
    unsigned char *bytes; // owned; `room` of them, `size` in use
    int64_t size, room;
} Encoded;

// At least `more` bytes of room behind those in use. ERROR_MEMORY.
bool encoded_reserve(Encoded *encoded, size_t more, Error *e);
bool encoded_append(Encoded *encoded, const void *bytes, size_t size, Error *e);
void encoded_clear(Encoded *encoded); // all 0 is fine

#endif
