// Are two pictures equal but for their noise? Each is the mean of a few renderings with seeds of
// their own, which know the variance of that mean. Blocks of pixels of 8 x 8, 16 x 16, ... up to
// the whole picture are compared channel by channel by Welch's test, and the many answers are
// judged together (Benjamini and Hochberg 1995): where nothing differs, the chance of any alarm is
// alpha.
//
// Blocks, because a pixel of a few samples is far from normal: sums over 64 and more pixels are
// not. All sizes, because a faint difference over a large part shows in large blocks only, a strong
// one in a small part in small ones only.
#ifndef RAMIFY_GOLDEN_NOISE_H
#define RAMIFY_GOLDEN_NOISE_H

#include "image/image.h"

typedef struct NoisyPicture {
    Image *mean;     // linear radiance, 3 channels
    Image *variance; // of the mean, per channel; 0 until there are 2 runs
    int runs;        // renderings that made it
} NoisyPicture;

// Black, of no runs yet. False and e when there is no memory.
bool noisy_picture_make(NoisyPicture *picture, int width, int height, Error *e);
void noisy_picture_clear(NoisyPicture *picture);

// Takes one more rendering into account: 3 floats a pixel. All must come from seeds of their own.
void noisy_picture_add(NoisyPicture *picture, const Image *rendering);

// As EXR: R, G, B; variance.R, variance.G, variance.B; runs.V.
bool noisy_picture_write(const NoisyPicture *picture, const char *file, Error *e);
bool noisy_picture_read(NoisyPicture *picture, const char *file, Error *e);

typedef struct NoiseBlock {
    int x, y, size; // pixels, from the top left; what lies outside the picture is not part of it
    int channel;    // 0 red, 1 green, 2 blue
    double z;       // difference over its standard deviation, as of a normal variable; signed
    double p;       // chance of such a difference without a cause
    double a, b;    // mean radiance
} NoiseBlock;

typedef struct NoiseVerdict {
    int64_t tests, rejected; // blocks times channels; how many differ
    double p;                // least alpha at which any would differ, 0..1
    NoiseBlock worst;        // the block that differs most surely
} NoiseVerdict;

// The size of the smallest blocks, pixels.
enum { NOISE_BLOCK = 8 };

// Differences of less than this share of the radiance are never reported: other instruction sets
// may make them.
#define NOISE_INDIFFERENT 5e-4

// Judges a - b; both of one size and at least 2 runs, or ERROR_INPUT. A value that is no number
// beside a number differs. *z (may be NULL): of each smallest block the z that is farthest from 0,
// one channel, a pixel a block; the caller frees it.
bool noise_compare(const NoisyPicture *a, const NoisyPicture *b, double alpha,
                   NoiseVerdict *verdict, Image **z, Error *e);

#endif
