// Text in HTML and XML.
#ifndef RAMIFY_BASE_MARKUP_H
#define RAMIFY_BASE_MARKUP_H

#include "base/file_writer.h"

// Writes text for an element or an attribute: < > & " ' are escaped; characters that XML does not
// allow (control characters, invalid UTF-8) become U+FFFD.
void markup_text(FileWriter *writer, const char *text);

// Writes bytes in base 64.
void markup_base64(FileWriter *writer, const unsigned char *bytes, size_t count);

#endif
