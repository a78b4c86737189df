// Gradient noise on hashed lattices, by + - * / only, so that geometry made from it has the same
// bits on every machine.
#ifndef RAMIFY_BASE_NOISE_H
#define RAMIFY_BASE_NOISE_H

#include "base/vec.h"

#include <stdint.h>

// Gradient noise in the plane (Perlin 2002, quintic fade): zero at lattice points, about -0.7 ..
// 0.7, wavelength 1.
float noise_plane(float x, float y, uint64_t seed);

// Sum of octaves, each with twice the frequency and half the amplitude of the one before.
float noise_plane_fractal(float x, float y, int octaves, uint64_t seed);

// The same in space.
float noise_space(Vec3 p, uint64_t seed);

#endif
