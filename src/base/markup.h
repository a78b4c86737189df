// Text as part of HTML and XML.
#ifndef RAMIFY_BASE_MARKUP_H
#define RAMIFY_BASE_MARKUP_H

#include "base/file_writer.h"

// Writes text so that it stands for itself in an element or an attribute: < > & " ' are escaped;
// what XML cannot hold (control characters, bytes that are no UTF-8) becomes U+FFFD.
void markup_text(FileWriter *writer, const char *text);

// Writes bytes in base 64.
void markup_base64(FileWriter *writer, const unsigned char *bytes, size_t count);

#endif
