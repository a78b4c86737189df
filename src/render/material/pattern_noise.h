// Noise on hashed integer lattices, for patterns.
#ifndef RAMIFY_RENDER_MATERIAL_PATTERN_NOISE_H
#define RAMIFY_RENDER_MATERIAL_PATTERN_NOISE_H

#include "base/vec.h"

#include <stdint.h>

// Gradient noise (Perlin 2002) and its gradient: 0 at lattice points, about -1..1, wavelength 1.
float noise_solid(Vec3 p, uint32_t seed, Vec3 *gradient); // gradient may be NULL

// Octaves of it, each of twice the frequency and half the height; about -1..1.
float noise_fractal(Vec3 p, int octaves, uint32_t seed);

// Space cut into cells, one about a random point of each unit cube (Worley 1996).
typedef struct CellPoint {
    float border;  // distance to the border toward the nearest neighbour
    Vec3 normal;   // unit, from that neighbour to this cell: the gradient of border
    uint32_t cell; // hash of the cell
    Vec3 point;    // of the cell, relative to the position
    uint32_t next; // hash of that neighbour
} CellPoint;

CellPoint noise_cells(Vec3 p, uint32_t seed);

// Hash of a unit square of a plane.
uint32_t noise_square(int x, int z, uint32_t seed);

// Uniform in [0, 1), from a hash and a number.
float noise_unit(uint32_t hash, uint32_t number);

#endif
