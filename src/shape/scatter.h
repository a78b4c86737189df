// Candidate draws for scattering. Draw number n is a function of the seed, n and the envelope
// alone. Shared by scatter.c, scatter_random.c, scatter_poisson.c and scatter_anchored.c.
#ifndef RAMIFY_SHAPE_SCATTER_H
#define RAMIFY_SHAPE_SCATTER_H

#include "shape/depth_field.h"
#include "shape/points.h"

typedef struct Scatter {
    const Envelope *envelope; // borrowed
    const ScatterParams *params;
    Transform frame;              // envelope_frame
    Vec3 lowest_corner;           // of the envelope's bounds
    Vec3 center;                  // fixed point of the scale
    float lowest, inverse_height; // m, 1/m: of the region, for the gradient
    double *cumulative;           // SCATTER_SURFACE: cumulative area of the faces, m^2
    bool weighted;                // the density is not uniform
    bool faces;                   // only a part of the surface counts: params->facing
    const DepthField *depth;      // the envelope's; NULL if the density does not depend on it
    double mean_shell;            // mean of the shell's density over the region
    double seen;                  // share of the surface that faces params->facing
    double mean_weight;           // share of the draws there, inside the region, that are kept
} Scatter;

typedef struct Draw {
    Vec3 position, normal;
    uint64_t id;
    bool inside; // in the region
    bool kept;   // inside, and accepted by the density
} Draw;

// Random streams of a draw, keyed by its id. The position takes one stream per coordinate: x, y, z
// in a volume; face, root, share on a surface.
enum { STREAM_POSITION = 1, STREAM_KEEP = 4, STREAM_LEVEL = 5 };

Draw scatter_draw(const Scatter *scatter, uint64_t number);

// Evaluates draws first .. first + count - 1 in parallel.
void scatter_draw_many(const Scatter *scatter, uint64_t first, int64_t count, Draw *draws,
                       const Run *run);

enum { SCATTER_ROUND = 1 << 18 }; // most draws per call

// Takes the first params->count kept draws.
bool scatter_random(const Scatter *scatter, PointSet *points, const Run *run, Error *e);

// Takes kept draws with a least distance that gives about params->count of them (dart throwing).
bool scatter_poisson(const Scatter *scatter, PointSet *points, const Run *run, Error *e);

// Takes the points of a lattice fixed in space that lie in the region; sets points->measure.
// (scatter_anchored.c)
bool scatter_anchored(const Scatter *scatter, PointSet *points, const Run *run, Error *e);

// Whether the density accepts the draw with this key at p, a point of the unscaled region.
bool scatter_keeps(const Scatter *scatter, Vec3 p, uint64_t key);

// Whether a surface with this normal, of length 1, faces params->facing.
bool scatter_faces(const Scatter *scatter, Vec3 normal);

// Sets the error for a region in which this many draws found no point.
bool scatter_empty_error(const Scatter *scatter, int64_t draws, Error *e);

#endif
