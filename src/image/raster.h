// Pixels as a PNG or JPEG stores them.
#ifndef RAMIFY_IMAGE_RASTER_H
#define RAMIFY_IMAGE_RASTER_H

#include <stddef.h>

// width * height * channels samples, row by row from the top left: 1 grey, 3 colours, or 4 with
// straight alpha. All pointers are the caller's.
typedef struct Raster {
    int width, height, channels;
    int sample_bytes; // 1, or 2 in the machine's order
    int linear;       // 1 = heights and the like; 0 = sRGB
    const void *samples;
    const char *metadata; // "key\0value\0...\0\0" pairs or NULL
} Raster;

static inline size_t raster_row_bytes(const Raster *raster)
{
    return (size_t)raster->width * (size_t)raster->channels * (size_t)raster->sample_bytes;
}

static inline const unsigned char *raster_row(const Raster *raster, int y)
{
    return (const unsigned char *)raster->samples + (size_t)y * raster_row_bytes(raster);
}

#endif
