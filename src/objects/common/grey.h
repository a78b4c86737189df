// Grey pictures as maps of land and densities.
#ifndef RAMIFY_OBJECTS_COMMON_GREY_H
#define RAMIFY_OBJECTS_COMMON_GREY_H

#include "image/image.h"

// Reads a picture and averages its colours, as stored; one channel, to be freed with image_free.
Image *grey_read(const char *file, const Run *run, Error *e);

// Bilinear; u and v run from 0 at the top left to 1. Clamped to the picture.
float grey_at(const Image *grey, float u, float v);

#endif
