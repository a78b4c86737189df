// Scatters points in an envelope or on its surface: attractors of growth, places of grass.
#ifndef RAMIFY_SHAPE_POINTS_H
#define RAMIFY_SHAPE_POINTS_H

#include "base/run.h"
#include "shape/envelope.h"

#include <stdint.h>

typedef struct PointSet {
    int64_t count, capacity;
    Vec3 *position; // m
    Vec3 *normal;   // unit: interpolated surface normal for surface points; (0, 1, 0) for volume
                    // points
    uint64_t *id;   // stable: a hash of the seed and the draw's number, independent of the array
                    // index
    double measure; // m^3 or m^2 of the region filled; determines the mean spacing
    int dimension;  // 3 in a volume, 2 on a surface
} PointSet;

typedef enum ScatterPlace { SCATTER_VOLUME, SCATTER_SURFACE } ScatterPlace;
typedef enum ScatterPattern {
    SCATTER_RANDOM, // independent uniform points
    SCATTER_POISSON // Poisson disk: no two closer than a distance that gives about `count` points
} ScatterPattern;

typedef struct ScatterParams {
    ScatterPlace place;
    ScatterPattern pattern;
    int64_t count; // number of points wanted, >= 1; exact for SCATTER_RANDOM
    uint64_t seed;
    float scale; // shrinks the envelope (or its surface) by this factor about its box's centre
    Vec3 scale_center; // used when scale_about_center is set
    bool scale_about_center;
    float shell;    // volume: share of the points, 0..1, pushed toward the surface: their density
                    // is t^4, with t = 0 at the deepest point, 1 at the surface
    float gradient; // density from bottom to top: -1 = only below, 0 = even, 1 = only above (linear
                    // in height)
    // density at a point of the unscaled region, 0..1, on top of the others; NULL = even
    float (*density)(const void *user, Vec3 p);
    const void *density_user;
    float depth_gradient; // volume: density from the centre to the surface, same scale as gradient
    Vec3 facing; // surface: points only where its normal is within 60 degrees of this direction, of
                 // any length; 0 = everywhere
    // points and their mean spacing stay fixed in space when the envelope moves or changes
    // slightly: SCATTER_RANDOM, about count points (the spacing is rounded to a quarter octave)
    bool anchored;
    Vec3 anchor; // origin of the lattice of anchored points
} ScatterParams;

ScatterParams scatter_params_default(void); // volume, random, 1000 points, seed 1, scale 1, even

// Scatters the points; the result does not depend on the number of threads. Poisson-disk points
// keep a distance of 0.75 to 0.8 of their mean spacing and may be fewer than count in thin regions.
// measure is that of the region at this scale. ERROR_INPUT when count exceeds 2^31 - 1 or the
// region is empty, ERROR_MEMORY when the points would not fit in memory. Free with points_free.
PointSet *points_scatter(const Envelope *envelope, const ScatterParams *params, const Run *run,
                         Error *e);

// Creates an empty set, filled by points_add.
PointSet *points_new(Error *e);
bool points_add(PointSet *points, Vec3 position, Vec3 normal, uint64_t id, Error *e);
void points_free(PointSet *points); // NULL is fine

// Mean spacing s = (measure / count)^(1 / dimension), m.
double points_spacing(const PointSet *points);

#endif
