// Implements number_text.h by std::to_chars, which C lacks.
#include "base/number_text.h"

#include <charconv>

char *float_text(char *out, float value)
{
    return std::to_chars(out, out + FLOAT_TEXT_MOST, value).ptr;
}

char *floats_text(char *out, const float *value, int count, char between)
{
    for (int i = 0; i < count; i++) {
        if (i > 0) {
            *out++ = between;
        }
        out = float_text(out, value[i]);
    }
    return out;
}

char *integer_text(char *out, int64_t value)
{
    return std::to_chars(out, out + INTEGER_TEXT_MOST, value).ptr;
}
