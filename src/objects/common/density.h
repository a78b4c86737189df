// Densities of attractors from files: OpenVDB grids and pictures.
#ifndef RAMIFY_OBJECTS_COMMON_DENSITY_H
#define RAMIFY_OBJECTS_COMMON_DENSITY_H

#include "base/run.h"
#include "base/vec.h"

// As in the scene file.
typedef struct DensityParams {
    const char *file;               // .vdb, or a picture
    char *grid;                     // name in the .vdb; NULL = the first of scalars
    Vec3 position, rotation, scale; // m, degrees: what a scene makes the transform of
    Transform transform;            // from the file's space: a grid's world, or a picture's 1 x 1
                                    // square about the origin, seen from above
    bool invert;
} DensityParams;

typedef struct Density Density;

// Reads the file. Errors have the key "file" or "grid". Free with density_free.
Density *density_new(const DensityParams *params, const Run *run, Error *e);
void density_free(Density *density); // NULL is fine

// 0..1 at p: a fog volume's share of its largest value; 1 inside a level set; a picture's grey, 0
// beside it. Thread-safe. density: a Density.
float density_at(const void *density, Vec3 p);

#endif
