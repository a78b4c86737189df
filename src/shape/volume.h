// Samples of a scalar or vector field on a regular grid, read from an OpenVDB file.
#ifndef RAMIFY_SHAPE_VOLUME_H
#define RAMIFY_SHAPE_VOLUME_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

enum { VOLUME_MOST = 256 }; // samples along an axis

typedef struct Volume {
    int size[3];        // samples along each axis
    int components;     // 1 or 3
    Transform to_index; // from the file's world (m) to sample numbers
    float background[3];
    float lowest, highest; // of a scalar field
    float *value;          // size[2] * size[1] * size[0] * components, x fastest
} Volume;

Volume *volume_new(const int size[3], int components, Error *e);
void volume_free(Volume *volume); // NULL is fine

// Reads the grid called name (NULL or "" = the first usable one) of an .vdb file. ERROR_INPUT names
// the file and the fault.
Volume *volume_read(const char *file, const char *name, const Run *run, Error *e);

// Trilinear interpolation at p, a point of the file's world; the background outside. value:
// `components` numbers. Thread-safe.
void volume_at(const Volume *volume, Vec3 p, float *value);

#endif
