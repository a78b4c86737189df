// Colour quantisation: each place gets the index of a palette entry, and each entry is the mean of
// its places, so the mean over all places is kept.
#ifndef RAMIFY_EXPORT_POV_PALETTE_H
#define RAMIFY_EXPORT_POV_PALETTE_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

enum { PALETTE_MOST = 256 };

typedef struct Palette {
    int count;
    Vec3 color[PALETTE_MOST];
    Vec3 second[PALETTE_MOST]; // a second value per colour: its mean over the entry's places
} Palette;

// color: `count` reflectances, 0..1. second: as many, or NULL. index: out, `count` indices of
// entries. At most `most` entries (<= PALETTE_MOST), by median cut (Heckbert 1982).
bool palette_make(const Vec3 *color, const Vec3 *second, int64_t count, int most, Palette *palette,
                  uint8_t *index, Error *e);

#endif
