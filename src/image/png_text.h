// Texts of PNG files in memory.
#ifndef RAMIFY_IMAGE_PNG_TEXT_H
#define RAMIFY_IMAGE_PNG_TEXT_H

#include <vector>

// Adds the pairs of metadata ("key\0value\0 ... \0"; NULL = none) to a sound PNG as tEXt chunks in
// front of its pixels. Throws std::bad_alloc.
void png_add_texts(std::vector<unsigned char> &png, const char *metadata);

#endif
