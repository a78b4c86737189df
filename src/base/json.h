// Text in JSON.
#ifndef RAMIFY_BASE_JSON_H
#define RAMIFY_BASE_JSON_H

#include <stdio.h>

// Writes text to the stream as a JSON string, with quotes; escapes ", \ and control characters.
void json_put_string(FILE *stream, const char *text);

#endif
