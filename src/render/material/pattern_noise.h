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

// Cells on a surface with a unit normal there: the points near it are taken as if they lay on it,
// so that no cell is the sliver that a cut through a solid one may be. About 1.2 cells a unit
// square; border, normal: along the surface.
CellPoint noise_cells_on(Vec3 p, Vec3 normal, uint32_t seed);

// Winding stripes on a surface with a unit normal there (phasor noise, Tricard et al. 2019): waves
// of one length in random directions along it, about random points.
typedef struct Stripes {
    float cosine, sine; // of the phase, which grows by 2 pi from a stripe to the next
    float strength;     // 0..1: near 0 where stripes end or fork, and the phase has no value
    Vec3 gradient;      // of the phase, along the surface
} Stripes;

// wavelength: below 0.6, in units of p.
Stripes noise_stripes_on(Vec3 p, Vec3 normal, float wavelength, uint32_t seed);

// Hash of a unit square of a plane.
uint32_t noise_square(int x, int z, uint32_t seed);

// Uniform in [0, 1), from a hash and a number.
float noise_unit(uint32_t hash, uint32_t number);

#endif
