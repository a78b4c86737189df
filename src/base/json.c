#include "base/json.h"

#include <math.h>

void json_put_string(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < ' ') {
            fprintf(stream, "\\u%04x", c);
        } else {
            fprintf(stream, c == '"' || c == '\\' ? "\\%c" : "%c", c);
        }
    }
    fputc('"', stream);
}

void json_put_number(FILE *stream, double value, int digits)
{
    if (isfinite(value)) {
        fprintf(stream, "%.*g", digits, value);
    } else {
        fputs("null", stream);
    }
}
