// How far a picture is from the stored one, in numbers and in pictures that show it.
#ifndef RAMIFY_GOLDEN_COMPARISON_H
#define RAMIFY_GOLDEN_COMPARISON_H

#include "golden/noise.h"
#include "image/compare.h"

// A PNG file in memory.
typedef struct Png {
    unsigned char *bytes; // owned; NULL = none
    size_t size;
} Png;

// What two pictures may differ by and still be alike. Negative = no such limit.
typedef struct Limits {
    double max_rmse;    // over all values
    double threshold;   // of a value's difference; for max_failing and the share that is told
    double max_failing; // share of pixels over the threshold
} Limits;

typedef struct Comparison {
    bool alike;
    char message[256];               // why not; "" when alike
    int width, height;               // of ours
    int stored_width, stored_height; // when they differ, there are no numbers
    bool same_size;
    ImageDifference difference; // of values as they are: display values, or radiance (linear)
    double psnr;                // dB, against 1 or, of radiance, the largest stored value
    double perceptual;          // mean of FLIP over the pictures as they are shown, 0..1
    bool statistical;
    NoiseVerdict noise; // when statistical
    double scale;       // map: the difference that has the full colour
    Png ours, stored, map;
} Comparison;

void comparison_clear(Comparison *comparison);

// Two pictures to be compared, and how they look: display values of 3 channels.
typedef struct Sides {
    const Image *ours, *stored; // values to be counted; 3 or 4 channels
    const Image *ours_shown, *stored_shown;
} Sides;

// Fills comparison (which it clears first, and the caller clears at last). pictures: make the PNGs
// too. Different sizes are a difference, not an error. False and e when there is no memory.
bool compare_pictures(const Sides *sides, const Limits *limits, bool pictures,
                      Comparison *comparison, Error *e);

// The same of two pictures that shall be equal but for noise: sides show their means.
bool compare_noisy(const Sides *sides, const NoisyPicture *ours, const NoisyPicture *stored,
                   double alpha, bool pictures, Comparison *comparison, Error *e);

// Compares two pictures of 3 or 4 channels as image_read_color gives them: radiance (linear) or
// display values, counted over black and with alpha where one of them is transparent. Radiance is
// shown with the exposure that suits `stored`.
bool compare_images(const Image *ours, const Image *stored, bool linear, const Limits *limits,
                    bool pictures, Comparison *comparison, Error *e);

// Compares two picture files of any kind that can be read. ERROR_INPUT when one cannot be read, or
// one holds radiance and one display values.
bool compare_files(const char *ours, const char *stored, const Limits *limits, bool pictures,
                   Comparison *comparison, Error *e);

#endif
