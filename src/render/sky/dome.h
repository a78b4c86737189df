// Radiance from all directions at infinity: a latitude-longitude table with bilinear lookup. The
// sky and HDR environments are domes.
//
// Directions are drawn in proportion to what of the luminance exceeds its mean, as lookup
// interpolates it between entries: the rest is even light, which BSDF sampling finds as well
// (Karlik et al., "MIS Compensation", SIGGRAPH Asia 2019). So whoever draws directions here must
// also find the dome by BSDF sampling.
#ifndef RAMIFY_RENDER_SKY_DOME_H
#define RAMIFY_RENDER_SKY_DOME_H

#include "base/color.h"
#include "base/error.h"

#include <stdint.h>

// Row 0 is at the zenith. Column 0 begins at azimuth +180 degrees (from +Z toward +X) and azimuth
// decreases with the column, so that the picture is not mirrored from inside (as in OpenEXR).
//
// Lookup is bilinear in azimuth and the sine of the elevation between the centres of entries. Its
// cells lie between these centres: cell (row, column) between the rows row - 1 and row, so there is
// one row of cells more than of entries; the first and the last reach to the poles.
typedef struct DomeEntry {
    Vec3 radiance;
    float weight; // excess of its luminance over the mean, 0 or more; filled by dome_prepare
} DomeEntry;

typedef struct Dome {
    int columns, rows;
    DomeEntry *entry;     // rows * columns; values are those at the entries' centres; owned
    bool horizon_spacing; // rows crowd toward the horizon (elevation ~ square) instead of even
    float rotation;       // radians about +Y
    float *edge;          // rows + 2: sines of the elevations between rows of cells; owned
    float *row_sum;       // rows + 2: cumulated share of the rows of cells; owned
    float *cell_sum;      // rows + 1 times columns + 1: cumulated share within each row; owned
    int32_t *row_guide;   // where to begin the search of row_sum; owned
    int32_t *cell_guide;  // the same for each row of cell_sum; owned
    float power;          // integral of the weight over all directions
} Dome;

// A black table; fill the entries' radiance, then call dome_prepare.
Dome *dome_new(int columns, int rows, bool horizon_spacing, float rotation, Error *e);
void dome_free(Dome *dome); // NULL is fine

// Fills weights and sampling tables. A dome of one colour has no power and is never sampled.
void dome_prepare(Dome *dome);

// Elevation, radians, of the row coordinate v: 0 at the top edge, 1 at the bottom one.
float dome_elevation(bool horizon_spacing, float v);

// Where a direction meets the table: a cell, and the place in it from its upper left corner, 0..1.
typedef struct DomePlace {
    int row, column;
    float x, y;
} DomePlace;

// Also begins to fetch the entries there from memory.
DomePlace dome_find(const Dome *dome, Vec3 direction);

Vec3 dome_radiance(const Dome *dome, const DomePlace *place);

static inline Vec3 dome_lookup(const Dome *dome, Vec3 direction)
{
    DomePlace place = dome_find(dome, direction);
    return dome_radiance(dome, &place);
}

typedef struct DomeLight {
    Vec3 radiance;
    float density; // per steradian, with which dome_sample draws the direction
} DomeLight;

DomeLight dome_at(const Dome *dome, const DomePlace *place);

// Unit direction for two uniform numbers, and what dome_at says of it. Needs power > 0.
Vec3 dome_sample(const Dome *dome, float u, float v, DomeLight *light);

#endif
