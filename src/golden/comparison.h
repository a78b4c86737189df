// Differences of a picture from the stored one, as numbers and as pictures.
#ifndef RAMIFY_GOLDEN_COMPARISON_H
#define RAMIFY_GOLDEN_COMPARISON_H

#include "golden/noise.h"
#include "image/compare.h"

// A PNG file in memory.
typedef struct Png {
    unsigned char *bytes; // owned; NULL = none
    size_t size;
} Png;

// Limits within which two pictures are alike. Negative = no limit.
typedef struct Limits {
    double max_rmse;    // over all values
    double threshold;   // of a value's difference; for max_failing and the reported fraction
    double max_failing; // fraction of pixels over the threshold
} Limits;

typedef struct Comparison {
    bool alike;
    char message[256];               // reason for failing; "" = alike
    int width, height;               // of ours
    int stored_width, stored_height; // if different, no numbers are computed
    bool same_size;
    ImageDifference difference; // of the values compared: display values, or radiance (linear)
    double psnr;                // dB, relative to 1 or, for radiance, the largest stored value
    double perceptual;          // mean FLIP of the pictures as displayed, 0..1
    bool statistical;
    NoiseVerdict noise; // if statistical
    double scale;       // map: the difference shown in full colour
    Png ours, stored, map;
} Comparison;

void comparison_clear(Comparison *comparison);

// Two pictures to compare, and their display values of 3 channels.
typedef struct Sides {
    const Image *ours, *stored; // values to compare; 3 or 4 channels
    const Image *ours_shown, *stored_shown;
} Sides;

// Fills comparison, which it clears first; the caller clears it in any case. pictures: make the
// PNGs too. Different sizes are a difference, not an error. False and e when out of memory.
bool compare_pictures(const Sides *sides, const Limits *limits, bool pictures,
                      Comparison *comparison, Error *e);

// The same for pictures that should be equal except for noise: sides show their means.
bool compare_noisy(const Sides *sides, const NoisyPicture *ours, const NoisyPicture *stored,
                   double alpha, bool pictures, Comparison *comparison, Error *e);

// Compares two pictures of 3 or 4 channels as read by image_read_color: radiance (linear) or
// display values, over black, and with alpha if one of them is transparent. Radiance is displayed
// with the exposure that suits `stored`.
bool compare_images(const Image *ours, const Image *stored, bool linear, const Limits *limits,
                    bool pictures, Comparison *comparison, Error *e);

// Compares two picture files of any readable format. ERROR_INPUT when one cannot be read, or one
// holds radiance and the other display values.
bool compare_files(const char *ours, const char *stored, const Limits *limits, bool pictures,
                   Comparison *comparison, Error *e);

#endif
