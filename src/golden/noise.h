// Tests whether two pictures are equal except for noise. Each is the mean of a few renderings with
// independent seeds, with the variance of that mean. Blocks of 8 x 8, 16 x 16, ... pixels up to the
// whole picture are compared channel by channel by Welch's test, and the results are corrected for
// multiple testing (Benjamini and Hochberg 1995): if nothing differs, the probability of any
// rejection is alpha.
//
// Blocks, because a pixel of a few samples is far from normally distributed, but sums over 64 and
// more pixels are nearly normal. All sizes, because a faint difference over a large area shows only
// in large blocks, a strong one in a small area only in small ones.
#ifndef RAMIFY_GOLDEN_NOISE_H
#define RAMIFY_GOLDEN_NOISE_H

#include "image/image.h"

typedef struct NoisyPicture {
    Image *mean;     // linear radiance, 3 channels
    Image *variance; // of the mean, per channel; 0 until there are 2 runs
    int runs;        // number of renderings
} NoisyPicture;

// Creates a black picture of 0 runs. False and e when out of memory.
bool noisy_picture_make(NoisyPicture *picture, int width, int height, Error *e);
void noisy_picture_clear(NoisyPicture *picture);

// Accumulates one more rendering: 3 floats per pixel. All must come from independent seeds.
void noisy_picture_add(NoisyPicture *picture, const Image *rendering);

// As EXR: R, G, B; variance.R, variance.G, variance.B; runs.V.
bool noisy_picture_write(const NoisyPicture *picture, const char *file, Error *e);
bool noisy_picture_read(NoisyPicture *picture, const char *file, Error *e);

typedef struct NoiseBlock {
    int x, y, size; // pixels, from the top left; pixels outside the picture do not count
    int channel;    // 0 red, 1 green, 2 blue
    double z;       // difference divided by its standard deviation, as of a normal variable; signed
    double p;       // probability of such a difference by chance
    double a, b;    // mean radiance
} NoiseBlock;

typedef struct NoiseVerdict {
    int64_t tests, rejected; // blocks times channels; how many differ
    double p;                // least alpha at which any would be rejected, 0..1
    NoiseBlock worst;        // the most significant block
} NoiseVerdict;

// Size of the smallest blocks, pixels.
enum { NOISE_BLOCK = 8 };

// Differences below this fraction of the radiance are never reported: other instruction sets may
// cause them.
#define NOISE_INDIFFERENT 5e-4

// Tests a - b; both of one size with at least 2 runs, else ERROR_INPUT. NaN beside a number counts
// as a difference. *z (may be NULL): the z farthest from 0 of each smallest block, one channel, one
// pixel per block; the caller frees it.
bool noise_compare(const NoisyPicture *a, const NoisyPicture *b, double alpha,
                   NoiseVerdict *verdict, Image **z, Error *e);

#endif
