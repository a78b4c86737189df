// Many colours as few: each place gets the number of an entry, each entry is the mean of what got
// it, so that the mean over all places stays as it was.
#ifndef RAMIFY_EXPORT_POV_PALETTE_H
#define RAMIFY_EXPORT_POV_PALETTE_H

#include "base/error.h"
#include "base/vec.h"

#include <stdint.h>

enum { PALETTE_MOST = 256 };

typedef struct Palette {
    int count;
    Vec3 color[PALETTE_MOST];
    Vec3 second[PALETTE_MOST]; // what goes with a colour: its mean over the entry's places
} Palette;

// color: `count` reflectances, 0..1. second: as many, or NULL. index: out, `count` numbers of
// entries. At most `most` entries (<= PALETTE_MOST), by median cut (Heckbert 1982).
bool palette_make(const Vec3 *color, const Vec3 *second, int64_t count, int most, Palette *palette,
                  uint8_t *index, Error *e);

#endif
