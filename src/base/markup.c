#include "base/markup.h"

#define REPLACEMENT "\xef\xbf\xbd"

// Length in bytes of the UTF-8 character at text; 0 if it is invalid or not allowed in XML 1.0.
static size_t character_length(const unsigned char *text)
{
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    unsigned char c = text[0];
    size_t length = c < 0x80 ? 1 : (c >> 5 == 6 ? 2 : (c >> 4 == 14 ? 3 : (c >> 3 == 30 ? 4 : 0)));
    unsigned code = length < 2 ? c : c & (0xffu >> (length + 1));
    for (size_t i = 1; i < length; i++) {
        if (text[i] >> 6 != 2) {
            return 0;
        }
        code = code << 6 | (text[i] & 0x3fu);
    }
    bool control = code < 0x20 && code != '\t' && code != '\n' && code != '\r';
    bool surrogate = code >= 0xd800 && code < 0xe000;
    bool none = code == 0x7f || code == 0xfffe || code == 0xffff || code > 0x10ffff;
    return length == 0 || control || surrogate || none || code < least[length] ? 0 : length;
}

static const char *escape_of(char c)
{
    switch (c) {
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '&':
        return "&amp;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return NULL;
    }
}

void markup_text(FileWriter *writer, const char *text)
{
    while (*text) {
        const char *escape = escape_of(*text);
        size_t length = character_length((const unsigned char *)text);
        if (escape || length == 0) {
            file_writer_text(writer, escape ? escape : REPLACEMENT);
            length = 1;
        } else {
            file_writer_bytes(writer, text, length);
        }
        text += length;
    }
}

void markup_base64(FileWriter *writer, const unsigned char *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        unsigned b[3] = {bytes[i], i + 1 < count ? bytes[i + 1] : 0u,
                         i + 2 < count ? bytes[i + 2] : 0u};
        unsigned group = b[0] << 16 | b[1] << 8 | b[2];
        char text[4] = {digits[group >> 18], digits[group >> 12 & 63],
                        i + 1 < count ? digits[group >> 6 & 63] : '=',
                        i + 2 < count ? digits[group & 63] : '='};
        file_writer_bytes(writer, text, sizeof text);
    }
}
