// Converts scalars of YAML 1.1 to numbers and back. The caller must have set the C locale.
#ifndef RAMIFY_CONFIG_SCALAR_H
#define RAMIFY_CONFIG_SCALAR_H

#include <stdbool.h>
#include <stdint.h>

// Parses a decimal number, with or without exponent, an 0x integer (underscores between digits are
// allowed), or .inf and .nan in any of their spellings. False for any other text.
bool scalar_number(const char *text, double *value);

// Parses a whole number as sign and magnitude; also accepts 1e6 and 250.0. False when the text is
// not a whole number or its magnitude exceeds 64 bits (*too_large is then true).
bool scalar_integer(const char *text, bool *negative, uint64_t *magnitude, bool *too_large);

// Parses true, false, yes, no, on, off in lower, upper or title case.
bool scalar_truth(const char *text, bool *value);

// Converts "#rrggbb" in sRGB to linear Rec. 709; false when the text is not such a colour.
bool scalar_color(const char *text, float rgb[3]);

// Shortest decimals that read back as the same float or double. text holds 32 characters.
void scalar_from_float(float value, char *text);
void scalar_from_double(double value, char *text);

#endif
