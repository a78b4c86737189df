// Radiance from all directions at infinity: a latitude-longitude table with bilinear lookup and
// sampling in proportion to luminance. The sky and HDR environments are domes.
#ifndef RAMIFY_RENDER_SKY_DOME_H
#define RAMIFY_RENDER_SKY_DOME_H

#include "base/color.h"
#include "base/error.h"

// Row 0 is at the zenith. Column 0 begins at azimuth +180 degrees (from +Z toward +X) and azimuth
// decreases with the column, so that the picture is not mirrored from inside (as in OpenEXR).
typedef struct Dome {
    int columns, rows;
    int block;            // a sampled cell is block * block entries; divides columns and rows
    Vec3 *radiance;       // rows * columns, at the cells' centres; owned
    bool horizon_spacing; // rows crowd toward the horizon (elevation ~ square) instead of even
    float rotation;       // radians about +Y
    float *edge;          // rows + 1: sines of the elevations between rows; owned
    float *row_sum;       // rows / block + 1: cumulated share of the rows of cells; owned
    float *cell_sum;      // a row of columns / block + 1 each: cumulated share within it; owned
    float *density;       // of each cell, per steradian; owned
    float power;          // integral of luminance over all directions
} Dome;

// A black table; fill radiance, then call dome_prepare. block: 1 for pictures; smooth skies are
// sampled by coarser cells, whose tables stay in the cache.
Dome *dome_new(int columns, int rows, int block, bool horizon_spacing, float rotation, Error *e);
void dome_free(Dome *dome); // NULL is fine

// Builds the sampling tables. A black dome is valid and never sampled.
void dome_prepare(Dome *dome);

// Elevation, radians, of the row coordinate v: 0 at the top edge, 1 at the bottom one.
float dome_elevation(bool horizon_spacing, float v);

Vec3 dome_lookup(const Dome *dome, Vec3 direction);

// Unit direction for two uniform numbers, and its density per steradian.
Vec3 dome_sample(const Dome *dome, float u, float v, float *density);
float dome_density(const Dome *dome, Vec3 direction);

#endif
