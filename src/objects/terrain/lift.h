// Land lifted by a tree of ridges (Tanaka et al., section 5.5): a band is swept along the tree, and
// a curve tells how high the land is lifted at each distance from its middle line.
#ifndef RAMIFY_OBJECTS_TERRAIN_LIFT_H
#define RAMIFY_OBJECTS_TERRAIN_LIFT_H

#include "base/run.h"
#include "base/vec.h"

#include <stdint.h>

// One stop of the curve, as in the scene file.
typedef struct LiftStop {
    float distance; // from the ridge, as a share of the band's half width
    float height;   // share of the relief
} LiftStop;

enum { LIFT_MOST_STOPS = 64 };

// The curve through the stops: a monotone cubic between two stops (Fritsch and Butland 1984), even
// before the first, 0 beyond the last.
typedef struct LiftCurve {
    int count;
    float distance[LIFT_MOST_STOPS], height[LIFT_MOST_STOPS], slope[LIFT_MOST_STOPS];
} LiftCurve;

// The stops' distances ascend; count 1 .. LIFT_MOST_STOPS.
LiftCurve lift_curve(const LiftStop *stop, int count);
float lift_curve_at(const LiftCurve *curve, float distance);

// The least and the largest value between two distances.
void lift_curve_range(const LiftCurve *curve, float from, float to, float *low, float *high);

// A piece of ridge from (x, z) along the unit direction (dx, dz). Its share runs evenly from share0
// to share1 (0..1, not both 0): both the height and the half width of the band are this share of
// the widest band's.
typedef struct RidgeBand {
    float x, z, dx, dz, length;
    float share0, share1;
} RidgeBand;

// The band's lift at a place, a share of the relief: share * curve(d / (share * half)), at the
// point of the ridge where d / share is least. half: m, of the widest band. The curve is not
// negative.
float ridge_band_lift(const RidgeBand *band, const LiftCurve *curve, float half, float x, float z);

typedef struct RidgeLift RidgeLift;

// Copies the bands. size, margin: see lowest_lists.h.
RidgeLift *ridge_lift_new(const RidgeBand *band, int64_t count, const LiftCurve *curve, float half,
                          float size, float margin, const Run *run, Error *e);
void ridge_lift_free(RidgeLift *lift); // NULL is fine

// The greatest lift of all bands at a place; 0 beyond them.
float ridge_lift_at(const RidgeLift *lift, float x, float z);

#endif
