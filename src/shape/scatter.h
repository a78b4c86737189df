// Draws: the candidates that scattering chooses from. Draw number n is a function of the seed, n
// and the envelope alone. Shared by scatter.c, scatter_random.c and scatter_poisson.c.
#ifndef RAMIFY_SHAPE_SCATTER_H
#define RAMIFY_SHAPE_SCATTER_H

#include "shape/depth_field.h"
#include "shape/points.h"

typedef struct Scatter {
    const Envelope *envelope; // borrowed
    const ScatterParams *params;
    Transform frame;              // of the envelope
    Vec3 lowest_corner;           // of its bounds
    Vec3 center;                  // that the scale keeps in place
    float lowest, inverse_height; // m, 1/m: of the region, for the gradient
    double *cumulative;           // SCATTER_SURFACE: area of the faces up to and with each, m^2
    bool weighted;                // densities other than even
    bool uses_depth;
    DepthField depth;
    double mean_shell;  // mean of the shell's density over the region
    double mean_weight; // share of the inner draws that are kept
} Scatter;

typedef struct Draw {
    Vec3 position, normal;
    uint64_t id;
    bool inside; // in the region
    bool kept;   // and chosen by the density
} Draw;

Draw scatter_draw(const Scatter *scatter, uint64_t number);

// Draws first .. first + count - 1, in parallel.
void scatter_draw_many(const Scatter *scatter, uint64_t first, int64_t count, Draw *draws,
                       const Run *run);

enum { SCATTER_ROUND = 1 << 18 }; // most draws at a time

// The first params->count kept draws.
bool scatter_random(const Scatter *scatter, PointSet *points, const Run *run, Error *e);

// Kept draws no two of which are nearer than a distance that makes about params->count (dart
// throwing).
bool scatter_poisson(const Scatter *scatter, PointSet *points, const Run *run, Error *e);

// Points of a lattice fixed in space, as many as the region holds; sets points->measure.
// (scatter_anchored.c)
bool scatter_anchored(const Scatter *scatter, PointSet *points, const Run *run, Error *e);

// Whether the density keeps a draw of this key at p, a place of the unscaled region.
bool scatter_keeps(const Scatter *scatter, Vec3 p, uint64_t key);

// What to say when this many draws found nothing.
bool scatter_empty_error(const Scatter *scatter, int64_t draws, Error *e);

#endif
