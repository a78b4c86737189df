// Quantises display values to 8 bits, dithered against banding. The threshold depends on the pixel
// alone: equal pictures give equal bytes, and the dither of an animation does not flicker.
#ifndef RAMIFY_IMAGE_QUANTISE_H
#define RAMIFY_IMAGE_QUANTISE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// value: 0..1, clamped; NaN gives 0. The mean over neighbouring pixels equals the value's, the
// error of each is below one step.
uint8_t quantise_dithered(float value, int x, int y, int channel);

// Rounds to the nearest step, for alpha.
uint8_t quantise_nearest(float value);

#ifdef __cplusplus
}
#endif

#endif
