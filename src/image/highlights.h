// Filters edges of lights and of the sky after their highlights are compressed, as a display of
// infinite resolution seen from afar would. The mean radiance of a pixel that a bright lamp covers
// by a hundredth is still white, so that its edge would be a staircase; the mean of what is shown
// is a hundredth of white.
#ifndef RAMIFY_IMAGE_HIGHLIGHTS_H
#define RAMIFY_IMAGE_HIGHLIGHTS_H

#include "base/vec.h"
#include "image/tonemap.h"

// The parts of each pixel's radiance that are by samples which saw a light or the sky, and the
// shares of these samples; the rest is by samples which saw a surface. width * height entries each,
// borrowed.
typedef struct HighlightParts {
    const Vec3 *light, *sky;
    const float *light_share, *sky_share;
} HighlightParts;

// Replaces each pixel of which several parts share by the radiance that is shown as the mean of
// what the parts are shown as. image: linear radiance, premultiplied, 4 channels, in place. excess:
// 3 channels; becomes what image lost, for tone_map. Other pixels keep their bits, with excess 0.
void highlights_compress(Image *image, Image *excess, const HighlightParts *parts,
                         const ToneParams *params);

#endif
