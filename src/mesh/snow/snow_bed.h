// What bears a pillow of snow, seen from above: the needles and twigs of a bough on a level grid,
// the outline of the snow that bridges the gaps between them, and the surface that it lies on.
#ifndef RAMIFY_MESH_SNOW_SNOW_BED_H
#define RAMIFY_MESH_SNOW_SNOW_BED_H

#include "mesh/snow/snow.h"

// A grid of points; point (x, z) is entry z * across + x and stands at low + cell * (x, z). The
// points of its border lie outside of the outline. Clear with snow_bed_clear.
typedef struct SnowBed {
    int across, along; // points along x and z
    float cell;        // m, between points
    float low_x, low_z;
    float *height;  // m: of the surface that bears the snow; NAN far from all bearers
    float *outline; // m: distance to the outline, > 0 inside
    float *share;   // of the full depth, where inside
    float *highest; // m: bearer near the point; bearers SNOW_STEP below it do not belong to the bed
} SnowBed;

#define SNOW_STEP 0.25f // m

// Lays out the bed of the highest of the bearers. Snow spans params->bridging; none lies where the
// surface is too steep, where little comes through, and in gaps, which `seed` places.
bool snow_bed_init(SnowBed *bed, const SnowBearer *bearer, int64_t count, const SnowParams *params,
                   const SnowReach *reach, uint64_t seed, Error *e);
void snow_bed_clear(SnowBed *bed);

// The point nearest to p, which must be a bearer.
int64_t snow_bed_entry(const SnowBed *bed, Vec3 p);

// Whether one of its bearers lies so far below others that the bed is not of it.
bool snow_bed_passes(const SnowBed *bed, Vec3 p);

// Thickness (m) of snow at every point of the bed, 0 outside of its outline; on a strip of half
// width w, at distance x from its middle: depth * share * sqrt(1 - cosh(x / L) / cosh(w / L)) with
// L = depth / sqrt(2). The caller frees the list; NULL and e when out of memory.
float *snow_thickness(const SnowBed *bed, float depth, Error *e);

#endif
