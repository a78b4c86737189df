// Texts and numbers in JSON.
#ifndef RAMIFY_BASE_JSON_H
#define RAMIFY_BASE_JSON_H

#include <stdio.h>

// Writes text to the stream as a JSON string, with quotes; escapes ", \ and control characters.
void json_put_string(FILE *stream, const char *text);

// Writes a number with this many significant digits; null unless it is finite, as JSON has neither
// infinity nor NAN.
void json_put_number(FILE *stream, double value, int digits);

#endif
