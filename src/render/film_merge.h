// Statistics of a pixel. Samples are summed as whole numbers, so the sum depends neither on the
// order of the samples nor on how they were divided between renderings (Demmel and Nguyen,
// "Parallel Reproducible Summation", IEEE Trans. Comput. 64(7), 2015, tell why floats cannot do
// that). A film stores a sum as the mean, which is rounded to a float, and the rest that this
// leaves.
//
// Radiance, positions and depths (m) are rounded to 2^-28 = 3.7e-9 and limited to 2^19 = 5.2e5 in
// magnitude; albedo, normals and shares to 2^-24 and 1; squared luminances to 2^-48. All sums of
// 2^24 samples, the most that a scene may ask for, are exact.
#ifndef RAMIFY_RENDER_FILM_MERGE_H
#define RAMIFY_RENDER_FILM_MERGE_H

#include "render/film.h"
#include "render/integrator.h"

enum {
    FILM_CHANNELS = 24, // of all means
    MOST_ADDED = 64     // samples of one PathSum: more might not be exact
};

__extension__ typedef __int128 WideInt;
__extension__ typedef unsigned __int128 WideUint;

// The sum of some paths.
typedef struct PathSum {
    double mean[FILM_CHANNELS]; // multiples of quanta, in the order of FilmMean
    WideUint squares;           // quanta
    int samples, hits;
    int object; // object + 1 of the first hit; 0 = none
    int64_t rays;
} PathSum;

// count: at most WAVE_SIZE; at most MOST_ADDED in all calls.
void path_sum_add(PathSum *sum, const PathResult path[], int count);

// The sum of a pixel's samples.
typedef struct PixelSum {
    WideInt mean[FILM_CHANNELS]; // quanta
    WideUint squares;
    int samples, hits, object;
} PixelSum;

// Adds later samples.
void pixel_sum_add(PixelSum *sum, const PathSum *later);
void pixel_sum_join(PixelSum *sum, const PixelSum *later);

// Reads and writes pixel i. One that has no samples gives the empty sum, which makes a pixel black,
// transparent and infinitely far.
void film_sum(const Film *film, int64_t i, PixelSum *sum);
void film_set(Film *film, int64_t i, const PixelSum *sum);

// Whether pixel i holds what film_set may have written: film_sum is undefined for anything else.
bool film_is_sound(const Film *film, int64_t i);

#endif
