// FNV-1a, 64 bits: hashes of bytes for names and marks; not cryptographic.
#ifndef RAMIFY_BASE_HASH_H
#define RAMIFY_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define HASH_START 0xcbf29ce484222325u // hash of no bytes

// Extends a hash by one byte.
static inline uint64_t hash_byte(uint64_t hash, unsigned char byte)
{
    return (hash ^ byte) * 0x100000001b3u;
}

static inline uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        hash = hash_byte(hash, ((const unsigned char *)bytes)[i]);
    }
    return hash;
}

#endif
