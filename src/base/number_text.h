// Formats numbers for files of millions of them: many times faster than printf and independent of
// the locale.
#ifndef RAMIFY_BASE_NUMBER_TEXT_H
#define RAMIFY_BASE_NUMBER_TEXT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { FLOAT_TEXT_MOST = 16, INTEGER_TEXT_MOST = 20 };

// Writes the shortest decimal text that reads back to the same float, as "0.1", "-3" or "1e-20"
// ("inf", "-inf" and "nan" if not finite), and returns its end. Not zero-terminated; `out` has room
// for FLOAT_TEXT_MOST characters.
char *float_text(char *out, float value);

// Writes `count` floats separated by `between`; room for count * (FLOAT_TEXT_MOST + 1).
char *floats_text(char *out, const float *value, int count, char between);

// The same for an integer: room for INTEGER_TEXT_MOST.
char *integer_text(char *out, int64_t value);

#ifdef __cplusplus
}
#endif

#endif
