// PNG Specification (Second Edition), sections 5.3 and 11.3.4.
#include "image/png_text.h"

#include <cstdint>
#include <cstring>
#include <zlib.h>

namespace
{

using Bytes = std::vector<unsigned char>;

const size_t SIGNATURE = 8, LENGTH = 4, TYPE = 4, CRC = 4;

uint32_t read_32(const unsigned char *at)
{
    return uint32_t(at[0]) << 24 | uint32_t(at[1]) << 16 | uint32_t(at[2]) << 8 | at[3];
}

void append_32(Bytes &bytes, size_t value)
{
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes.push_back((unsigned char)(value >> shift));
    }
}

// A chunk: its length, its type and data, and a check sum of those two.
void append_text(Bytes &bytes, const char *key, const char *value)
{
    size_t name = std::strlen(key) + 1, length = name + std::strlen(value);
    append_32(bytes, length);
    size_t from = bytes.size();
    bytes.insert(bytes.end(), {'t', 'E', 'X', 't'});
    bytes.insert(bytes.end(), key, key + name);
    bytes.insert(bytes.end(), value, value + length - name);
    append_32(bytes, crc32_z(0, bytes.data() + from, bytes.size() - from));
}

// Where the first chunk of pixels begins.
size_t find_pixels(const Bytes &png)
{
    size_t at = SIGNATURE;
    while (at + LENGTH + TYPE <= png.size() && std::memcmp(&png[at + LENGTH], "IDAT", TYPE) != 0) {
        at += LENGTH + TYPE + read_32(&png[at]) + CRC;
    }
    return at;
}

} // namespace

void png_add_texts(Bytes &png, const char *metadata)
{
    Bytes texts;
    for (const char *key = metadata; key && *key;) {
        const char *value = key + std::strlen(key) + 1;
        append_text(texts, key, value);
        key = value + std::strlen(value) + 1;
    }
    size_t at = texts.empty() ? png.size() : find_pixels(png);
    if (at < png.size()) {
        png.insert(png.begin() + ptrdiff_t(at), texts.begin(), texts.end());
    }
}
