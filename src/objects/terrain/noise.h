// Sparse convolution noise (Tanaka et al., eq. (16); Lewis 1989): the sum of kernels at the points
// of a Poisson process, each with a random weight.
#ifndef RAMIFY_OBJECTS_TERRAIN_NOISE_H
#define RAMIFY_OBJECTS_TERRAIN_NOISE_H

#include <stdint.h>

// Mean 0, variance 1, band-limited to about one wave per unit of length (the kernel's integral is
// 0). A pure function of place and seed.
float sparse_noise(float x, float y, uint64_t seed);

// The number of kernels in a unit cell: Poisson distributed, of mean SPARSE_NOISE_DENSITY.
int sparse_noise_count(uint64_t cell_key);
#define SPARSE_NOISE_DENSITY 3.0f

// `iterations` octaves, each rotated, with twice the frequency and `gain` times the height of the
// last. ridged 0..1 blends each from round to sharp crests.
float sparse_noise_fractal(float x, float y, int iterations, float gain, float ridged,
                           uint64_t seed);

// sparse_noise_fractal at `count` places, with the same bits, in less time the closer each place
// is to the one before. x, y: the places, of which nothing is left. sum: the results.
void sparse_noise_fractal_along(float *x, float *y, int count, int iterations, float gain,
                                float ridged, uint64_t seed, float *sum);

#endif
