// Scalars of YAML 1.1 to numbers and back, in the C locale's spelling (callers see to the locale).
#ifndef RAMIFY_CONFIG_SCALAR_H
#define RAMIFY_CONFIG_SCALAR_H

#include <stdbool.h>
#include <stdint.h>

// A decimal number, with or without exponent, an 0x integer, underscores between digits allowed, or
// .inf and .nan in any of their spellings. False when the text is none of these.
bool scalar_number(const char *text, double *value);

// A whole number as sign and magnitude; also accepts 1e6 and 250.0. False when the text is no whole
// number or its magnitude exceeds 64 bits (*too_large tells).
bool scalar_integer(const char *text, bool *negative, uint64_t *magnitude, bool *too_large);

// true, false, yes, no, on, off in lower, upper or title case.
bool scalar_truth(const char *text, bool *value);

// "#rrggbb" in sRGB to linear Rec. 709; false when the text is no such colour.
bool scalar_color(const char *text, float rgb[3]);

// Shortest decimals that read back as the same float or double. text holds 32 characters.
void scalar_from_float(float value, char *text);
void scalar_from_double(double value, char *text);

#endif
