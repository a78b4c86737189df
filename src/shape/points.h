// Scattering points in an envelope or on its surface: the attractors of growth, the places of
// grass.
#ifndef RAMIFY_SHAPE_POINTS_H
#define RAMIFY_SHAPE_POINTS_H

#include "base/run.h"
#include "shape/envelope.h"

#include <stdint.h>

typedef struct PointSet {
    int64_t count, capacity;
    Vec3 *position; // m
    Vec3 *normal;   // unit: the surface's, interpolated, for surface points; (0, 1, 0) for volume
                    // points
    uint64_t *id; // stable: a hash of the seed and the point's draw, not of its place in the array
    double measure; // m^3 or m^2 of the region filled, for the mean spacing
    int dimension;  // 3 in a volume, 2 on a surface
} PointSet;

typedef enum ScatterPlace { SCATTER_VOLUME, SCATTER_SURFACE } ScatterPlace;
typedef enum ScatterPattern {
    SCATTER_RANDOM, // independent uniform points
    SCATTER_POISSON // no two closer than a distance that makes about `count` points (Poisson disk)
} ScatterPattern;

typedef struct ScatterParams {
    ScatterPlace place;
    ScatterPattern pattern;
    int64_t count; // wanted points, >= 1; exact for SCATTER_RANDOM
    uint64_t seed;
    float
        scale; // keep to the envelope (or its surface) shrunk by this factor about its box's centre
    Vec3 scale_center; // used when scale_about_center is set
    bool scale_about_center;
    float shell;    // volume: share of the points, 0..1, that is pushed toward the surface: their
                    // density is that of t^4, t = 0 at the deepest place, 1 at the surface
    float gradient; // density from bottom to top: -1 = only below, 0 = even, 1 = only above (linear
                    // in height)
    float depth_gradient; // volume: density from the middle to the surface, as gradient
    bool anchored; // the points stay where they are in space, and their mean spacing too, when the
                   // envelope moves or changes a little: SCATTER_RANDOM, about count points (their
                   // spacing is rounded to a quarter octave)
    Vec3 anchor;   // of anchored points: they move with it
} ScatterParams;

ScatterParams scatter_params_default(void); // volume, random, 1000 points, seed 1, scale 1, even

// The same points for any number of threads. Poisson-disk points keep a distance of 0.75 to 0.8 of
// their mean spacing and may fall short of count where the region is thin. measure is that of the
// region at this scale. ERROR_INPUT when count is absurd (over 2^31 - 1) or the region is empty,
// ERROR_MEMORY when the points would not fit in this machine's memory.
PointSet *points_scatter(const Envelope *envelope, const ScatterParams *params, const Run *run,
                         Error *e);

// Empty set to be filled by hand.
PointSet *points_new(Error *e);
bool points_add(PointSet *points, Vec3 position, Vec3 normal, uint64_t id, Error *e);
void points_free(PointSet *points); // NULL is fine

// Mean spacing s = (measure / count)^(1 / dimension), m.
double points_spacing(const PointSet *points);

#endif
