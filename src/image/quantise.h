// Display values as 8 bits, dithered so that dark gradients show no bands. The threshold depends on
// the pixel alone: the same picture has the same bytes each time, and a film's noise stands still.
#ifndef RAMIFY_IMAGE_QUANTISE_H
#define RAMIFY_IMAGE_QUANTISE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// value: 0..1, cut off there; NaN gives 0. The mean over neighbouring pixels is the value's, the
// error of each is below one step.
uint8_t quantise_dithered(float value, int x, int y, int channel);

// To the nearest step: for alpha.
uint8_t quantise_nearest(float value);

#ifdef __cplusplus
}
#endif

#endif
