// A density on a regular grid of which only blocks with values are kept, read from an OpenVDB file.
#ifndef RAMIFY_SHAPE_SPARSE_VOLUME_H
#define RAMIFY_SHAPE_SPARSE_VOLUME_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

enum {
    SPARSE_SIDE = 8,          // samples along a block's side
    SPARSE_SAMPLES = 512,     // of a block
    SPARSE_MOST = 1024,       // blocks along an axis
    SPARSE_MOST_ALL = 1 << 26 // blocks, with and without values
};

typedef struct SparseVolume {
    int blocks[3];      // along each axis
    int32_t kept;       // blocks with values
    Transform to_index; // from the file's world (m) to sample numbers
    float highest;      // value; all are finite and >= 0
    int32_t *block;     // number of a block's values, x fastest; -1 = all are 0; owned
    float *value;       // kept blocks of 8 x 8 x 8 samples, z fastest; owned
} SparseVolume;

// With nothing but zeroes. ERROR_MEMORY.
SparseVolume *sparse_volume_new(const int blocks[3], int32_t kept, Error *e);
void sparse_volume_free(SparseVolume *volume); // NULL is fine

// Reads the grid of floats called name (NULL or "" = the first one) of an .vdb file: a fog volume's
// values, negative ones as 0, or the inside of a level set, where the density rises from 0 at the
// surface to 1 across its band. ERROR_INPUT names the file and the fault; error key "grid" where
// the file has no such grid.
SparseVolume *sparse_volume_read(const char *file, const char *name, const Run *run, Error *e);

int64_t sparse_volume_bytes(const SparseVolume *volume); // that it takes

// Bytes that reading a grid will take, by what the file tells; 0 if it cannot be read.
int64_t sparse_volume_estimate(const char *file, const char *name, const Run *run);

// The sample with these numbers; 0 outside.
static inline float sparse_volume_sample(const SparseVolume *v, int x, int y, int z)
{
    int i = x >> 3, j = y >> 3, k = z >> 3;
    if ((unsigned)i >= (unsigned)v->blocks[0] || (unsigned)j >= (unsigned)v->blocks[1] ||
        (unsigned)k >= (unsigned)v->blocks[2]) {
        return 0.0f;
    }
    int32_t at = v->block[((int64_t)k * v->blocks[1] + j) * v->blocks[0] + i];
    return at < 0 ? 0.0f
                  : v->value[(int64_t)at * SPARSE_SAMPLES + ((x & 7) * 8 + (y & 7)) * 8 + (z & 7)];
}

// Trilinear interpolation between samples; p in sample numbers, less than 2^30.
float sparse_volume_at(const SparseVolume *volume, Vec3 p);

#endif
